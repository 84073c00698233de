// SPDX-License-Identifier: MIT
#include <algorithm>
#include <stdexcept>
#include <string>

#include "tracer/base/error.h"
#include "tracer/base/file_bytes.h"
#include "tracer/scene/decode_image.h"
#include "tracer/scene/environment.h"

namespace tracer {
namespace {

/// Radiance, in [0, 1e30].
Vec3f usable(const Vec3f& texel) {
  const auto channel = [](float value) { return value > 0 ? std::min(value, 1e30f) : 0.0f; };
  return {channel(texel.x), channel(texel.y), channel(texel.z)};
}

LatLongImage decode_lat_long(std::string_view bytes) {
  if (!is_radiance_image(bytes)) {
    throw std::runtime_error("neither a Radiance .hdr nor an OpenEXR picture");
  }
  const Texture texture = decode_image(bytes, TexelEncoding::linear);
  if (texture.width != 2 * texture.height) {
    throw std::runtime_error("an environment map is twice as wide as it is high; this one is " +
                             std::to_string(texture.width) + " x " +
                             std::to_string(texture.height));
  }
  const auto channel_count = static_cast<size_t>(texture.channel_count);
  LatLongImage image{texture.width, texture.height, {}};
  image.texels.reserve(texture.values.size() / channel_count);
  for (size_t i = 0; i < texture.values.size(); i += channel_count) {
    const float* v = &texture.values[i];
    image.texels.push_back(usable(channel_count == 1 ? Vec3f(v[0]) : Vec3f(v[0], v[1], v[2])));
  }
  return image;
}

}  // namespace

std::shared_ptr<const Environment> load_environment(const std::filesystem::path& path) {
  const FileBytes file(path);
  try {
    return std::make_shared<const Environment>(SkyMap(decode_lat_long(file.bytes())));
  } catch (const std::runtime_error& error) {
    throw LoadError({.path = path.string(), .what = error.what()});
  }
}

bool is_environment_file(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension == ".hdr" || extension == ".exr";
}

}  // namespace tracer
