// SPDX-License-Identifier: MIT
#include "tracer/scene/import_textures.h"

#include <atomic>
#include <optional>
#include <utility>

#include "tracer/base/parallel.h"

namespace tracer {
namespace {

struct DecodedTexture {
  Texture texture;
  std::optional<std::string> fault;
};

Texture load(const TextureImporter::Request& request) {
  const bool has_colors = request.use == TextureUse::colors;
  Texture texture =
      load_texture(request.path, has_colors ? TexelEncoding::srgb : TexelEncoding::linear);
  const bool has_heights = request.use == TextureUse::normals && is_grey(texture);
  return has_heights ? normals_of_heights(texture) : std::move(texture);
}

}  // namespace

uint32_t TextureImporter::add(Request request) {
  const std::string key = std::to_string(static_cast<int>(request.use)) + request.path.string();
  const auto [entry, is_new] = known_.try_emplace(key, static_cast<uint32_t>(requests_.size()));
  if (is_new) requests_.push_back(std::move(request));
  return entry->second;
}

void TextureImporter::read(Progress& progress, Warnings& warnings) {
  progress.start_stage("reading textures");
  std::vector<DecodedTexture> decoded(requests_.size());
  std::atomic<size_t> done{0};
  parallel_for_each_index(0, requests_.size(), [&](size_t i) {
    progress.throw_if_stopped();
    try {
      decoded[i].texture = load(requests_[i]);
    } catch (const LoadError& error) {
      decoded[i].fault = error.what();
    }
    progress.set_fraction(static_cast<double>(++done) / static_cast<double>(requests_.size()));
  });
  for (size_t i = 0; i < decoded.size(); ++i) {
    const Request& request = requests_[i];
    if (!decoded[i].fault) {
      indices_.push_back(static_cast<uint32_t>(textures_.size()));
      textures_.push_back(std::move(decoded[i].texture));
      continue;
    }
    warnings.add({request.library, request.line, request.keyword + ": " + *decoded[i].fault});
    indices_.push_back(request.use == TextureUse::colors ? checker() : no_texture);
  }
}

uint32_t TextureImporter::checker() {
  if (checker_ == no_texture) {
    checker_ = static_cast<uint32_t>(textures_.size());
    textures_.push_back(make_checker());
  }
  return checker_;
}

}  // namespace tracer
