// SPDX-License-Identifier: MIT
#include "tracer/scene/texture.h"

#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include <stb_image.h>

#include "tracer/base/error.h"
#include "tracer/base/file_bytes.h"
#include "tracer/scene/jpeg_tables.h"
#include "tracer/scene/pnm_header.h"

namespace tracer {
namespace {

constexpr int64_t max_texels = int64_t{1} << 27;

struct FreeImage {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};
template <class T>
using DecodedPixels = std::unique_ptr<T[], FreeImage>;

/// Linear value of each 8-bit sRGB code [IEC 61966-2-1].
const std::array<float, 256>& srgb_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (int code = 0; code < 256; ++code) {
      const double encoded = code / 255.0;
      values[code] = static_cast<float>(
          encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
    }
    return values;
  }();
  return table;
}

/// An encoded image in memory, and where to put the faults.
class Decoder {
 public:
  explicit Decoder(const std::filesystem::path& path) : path_(path), file_(path) {
    if (file_.bytes().empty()) fail("the image file is empty");
    if (file_.bytes().size() > static_cast<size_t>(std::numeric_limits<int>::max())) {
      fail("the image file is too large");
    }
    bytes_ = reinterpret_cast<const stbi_uc*>(file_.bytes().data());
    size_ = static_cast<int>(file_.bytes().size());
    if (!has_sound_huffman_tables(file_.bytes())) fail("a damaged JPEG: too many Huffman codes");
    if (!has_sound_pnm_header(file_.bytes())) fail("a PNM too large, or of more than 8 bits");
    check_dimensions();
  }

  Texture decode() const {
    return stbi_is_hdr_from_memory(bytes_, size_) ? decode_float() : decode_8_bit();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw LoadError({path_.string(), 0, what});
  }
  [[noreturn]] void fail_to_decode() const {
    const char* reason = stbi_failure_reason();
    const bool has_reason = reason && *reason;
    fail(std::string("no image that can be read: ") +
         (has_reason ? reason : "unknown format, or damaged"));
  }

  void check_dimensions() const {
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes_, size_, &width, &height, &channels)) fail_to_decode();
    if (width < 1 || height < 1) fail("the image has no pixels");
    if (int64_t{width} * height > max_texels) fail("the image has too many pixels");
  }

  Texture decode_8_bit() const {
    Texture texture;
    int channels = 0;
    const DecodedPixels<stbi_uc> pixels(
        stbi_load_from_memory(bytes_, size_, &texture.width, &texture.height, &channels, 3));
    if (!pixels) fail_to_decode();
    const std::array<float, 256>& linear = srgb_table();
    texture.texels.resize(static_cast<size_t>(texture.width) * texture.height);
    for (size_t i = 0; i < texture.texels.size(); ++i) {
      const stbi_uc* code = pixels.get() + 3 * i;
      texture.texels[i] = {linear[code[0]], linear[code[1]], linear[code[2]]};
    }
    return texture;
  }

  Texture decode_float() const {
    Texture texture;
    int channels = 0;
    const DecodedPixels<float> pixels(
        stbi_loadf_from_memory(bytes_, size_, &texture.width, &texture.height, &channels, 3));
    if (!pixels) fail_to_decode();
    texture.texels.resize(static_cast<size_t>(texture.width) * texture.height);
    for (size_t i = 0; i < texture.texels.size(); ++i) {
      const float* value = pixels.get() + 3 * i;
      texture.texels[i] = {value[0], value[1], value[2]};
    }
    return texture;
  }

  const std::filesystem::path& path_;
  FileBytes file_;
  const stbi_uc* bytes_ = nullptr;
  int size_ = 0;
};

/// Two neighbouring texels along an axis and how far between their centres, 0 to 1.
struct TexelPair {
  int first = 0;
  int second = 0;
  double weight = 0;  // of the second
};

/// Around `coordinate`, repeated; what is not finite counts as 0.
TexelPair texels_around(double coordinate, int size) {
  const double fraction = std::isfinite(coordinate) ? coordinate - std::floor(coordinate) : 0.0;
  const double place = fraction * size - 0.5;
  const double first = std::floor(place);
  const int index = static_cast<int>(first);
  return {(index + size) % size, (index + 1) % size, place - first};
}

}  // namespace

Texture load_texture(const std::filesystem::path& path) {
  return Decoder(path).decode();
}

Vec3f eval_texture(const Texture& texture, const Vec2f& uv) {
  if (texture.texels.empty()) return Vec3f(1.0f);
  const TexelPair column = texels_around(uv.x, texture.width);
  const TexelPair row = texels_around(-static_cast<double>(uv.y), texture.height);
  const auto texel = [&](int x, int y) {
    return Vec3d(texture.texels[static_cast<size_t>(y) * texture.width + x]);
  };
  const Vec3d upper = (1 - column.weight) * texel(column.first, row.first) +
                      column.weight * texel(column.second, row.first);
  const Vec3d lower = (1 - column.weight) * texel(column.first, row.second) +
                      column.weight * texel(column.second, row.second);
  return Vec3f((1 - row.weight) * upper + row.weight * lower);
}

}  // namespace tracer
