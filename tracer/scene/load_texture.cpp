// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <memory>

#include <stb_image.h>

#include "tracer/base/error.h"
#include "tracer/base/file_bytes.h"
#include "tracer/scene/decode_exr.h"
#include "tracer/scene/hdr_runs.h"
#include "tracer/scene/jpeg_tables.h"
#include "tracer/scene/pnm_header.h"
#include "tracer/scene/texture.h"

namespace tracer {
namespace {

struct FreeImage {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};
template <class T>
using DecodedPixels = std::unique_ptr<T[], FreeImage>;

/// An encoded image in memory, and where to put the faults.
class Decoder {
 public:
  Decoder(const std::filesystem::path& path, TexelEncoding encoding)
      : path_(path), file_(path), encoding_(encoding) {
    if (file_.bytes().empty()) fail("the image file is empty");
    if (file_.bytes().size() > static_cast<size_t>(std::numeric_limits<int>::max())) {
      fail("the image file is too large");
    }
    bytes_ = reinterpret_cast<const stbi_uc*>(file_.bytes().data());
    size_ = static_cast<int>(file_.bytes().size());
  }

  Texture decode() const {
    Texture texture = decode_finest();
    for (float& value : texture.values) {
      if (!std::isfinite(value)) value = 0;
    }
    add_levels(texture);
    return texture;
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

  Texture decode_finest() const {
    if (is_exr(file_.bytes())) {
      try {
        return decode_exr(file_.bytes());
      } catch (const std::exception& error) {
        fail(std::string("no image that can be read: ") + error.what());
      }
    }
    if (!has_sound_huffman_tables(file_.bytes())) fail("a damaged JPEG: too many Huffman codes");
    if (!has_sound_pnm_header(file_.bytes())) fail("a PNM too large, or of more than 8 bits");
    if (!has_sound_hdr_runs(file_.bytes())) fail("a damaged HDR: rows that end too early");
    const int channel_count = check_header();
    if (stbi_is_hdr_from_memory(bytes_, size_)) return decode_float();
    return decode_8_bit(channel_count);
  }

  /// The channels to keep.
  int check_header() const {
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes_, size_, &width, &height, &channels)) fail_to_decode();
    if (width < 1 || height < 1) fail("the image has no pixels");
    if (int64_t{width} * height > max_texels) fail("the image has too many pixels");
    return channels == 2 ? 4 : channels;
  }

  Texture decode_8_bit(int channel_count) const {
    Texture texture;
    int in_file = 0;
    const DecodedPixels<stbi_uc> pixels(stbi_load_from_memory(
        bytes_, size_, &texture.width, &texture.height, &in_file, channel_count));
    if (!pixels) fail_to_decode();
    texture.channel_count = channel_count;
    texture.encoding = encoding_;
    texture.codes.assign(pixels.get(), pixels.get() + value_count(texture));
    return texture;
  }

  Texture decode_float() const {
    Texture texture;
    int in_file = 0;
    const DecodedPixels<float> pixels(
        stbi_loadf_from_memory(bytes_, size_, &texture.width, &texture.height, &in_file, 3));
    if (!pixels) fail_to_decode();
    texture.values.assign(pixels.get(), pixels.get() + value_count(texture));
    return texture;
  }

  static size_t value_count(const Texture& texture) {
    return static_cast<size_t>(texture.width) * texture.height * texture.channel_count;
  }

  const std::filesystem::path& path_;
  FileBytes file_;
  TexelEncoding encoding_;
  const stbi_uc* bytes_ = nullptr;
  int size_ = 0;
};

}  // namespace

Texture load_texture(const std::filesystem::path& path, TexelEncoding encoding) {
  return Decoder(path, encoding).decode();
}

}  // namespace tracer
