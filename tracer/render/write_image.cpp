// SPDX-License-Identifier: MIT
#include "tracer/render/write_image.h"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "tracer/base/error.h"
#include "tracer/base/write_file.h"
#include "tracer/render/image_formats.h"

namespace tracer {
namespace {

/// All that a picture's file may be told.
struct Content {
  const Image& image;
  double exposure;
  const Metadata& metadata;
  std::span<const ImageLayer> layers;
};

struct Format {
  std::string_view extension;
  std::string (*encode)(const Content& content);
  bool holds_layers = false;
};
constexpr Format formats[] = {
    {".png", [](const Content& c) { return encode_png(c.image, c.exposure, c.metadata); }},
    {".exr", [](const Content& c) { return encode_exr(c.image, c.metadata, c.layers); }, true},
    {".pfm", [](const Content& c) { return encode_pfm(c.image, c.exposure, c.metadata); }}};

const Format* find_format(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  const auto* found = std::ranges::find(formats, extension, &Format::extension);
  return found == std::end(formats) ? nullptr : found;
}

void append_little_endian(std::string& bytes, float value) {
  const auto word = std::bit_cast<uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 0xff);
}

}  // namespace

std::string encode_pfm(const Image& image, double /*exposure*/, const Metadata& /*metadata*/) {
  const Vec2i size = image.size_px;
  // The negative scale says little-endian.
  std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", size.x, size.y);
  bytes.reserve(bytes.size() + sizeof(Vec3f) * image.pixels.size());
  for (int y = size.y - 1; y >= 0; --y) {
    for (int x = 0; x < size.x; ++x) {
      const Vec3f& pixel = image.pixels[static_cast<size_t>(y) * size.x + x];
      for (int channel = 0; channel < 3; ++channel) append_little_endian(bytes, pixel[channel]);
    }
  }
  return bytes;
}

bool is_writable_image(const std::filesystem::path& path) {
  return find_format(path) != nullptr;
}

bool can_hold_layers(const std::filesystem::path& path) {
  const Format* format = find_format(path);
  return format != nullptr && format->holds_layers;
}

void write_image(const std::filesystem::path& path, const Image& image, double exposure,
                 const std::map<std::string, std::string>& metadata,
                 std::span<const ImageLayer> layers) {
  const Format* format = find_format(path);
  if (format == nullptr) {
    throw LoadError({.path = path.string(), .what = "pictures are written as .png, .exr or .pfm"});
  }
  if (!layers.empty() && !format->holds_layers) {
    throw LoadError({.path = path.string(), .what = "layers are written as .exr alone"});
  }
  std::string bytes;
  try {
    bytes = format->encode({image, exposure, metadata, layers});
  } catch (const std::exception& error) {
    throw LoadError({.path = path.string(), .what = error.what()});
  }
  write_file(path, bytes);
}

}  // namespace tracer
