// SPDX-License-Identifier: MIT
#include "tracer/scene/decode_image.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include <stb_image.h>

#include "tracer/scene/decode_exr.h"
#include "tracer/scene/hdr_runs.h"
#include "tracer/scene/jpeg_tables.h"
#include "tracer/scene/png_chunks.h"
#include "tracer/scene/pnm_header.h"
#include "tracer/scene/stb_growth.h"

namespace tracer {
namespace {

struct FreeImage {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};
template <class T>
using DecodedPixels = std::unique_ptr<T[], FreeImage>;

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what);
}
[[noreturn]] void fail_to_decode() {
  const char* reason = stbi_failure_reason();
  const bool has_reason = reason && *reason;
  fail(std::string("no image that can be read: ") +
       (has_reason ? reason : "unknown format, or damaged"));
}

Texture decode_whole_exr(std::string_view bytes) {
  try {
    return decode_exr(bytes);
  } catch (const std::exception& error) {
    fail(std::string("no image that can be read: OpenEXR: ") + error.what());
  }
}

/// All that is not OpenEXR.
class StbDecoder {
 public:
  explicit StbDecoder(std::string_view bytes)
      : bytes_(reinterpret_cast<const stbi_uc*>(bytes.data())),
        size_(static_cast<int>(bytes.size())) {}

  Texture decode(TexelEncoding encoding) const {
    const Header header = check_header();
    if (stbi_is_hdr_from_memory(bytes_, size_)) return decode_float();
    return decode_8_bit(header, encoding);
  }

 private:
  struct Header {
    int width, height, channels;

    /// 8 bytes a pixel and one a row hold all formats.
    size_t most_bytes() const {
      return (8 * static_cast<size_t>(width) + 1) * static_cast<size_t>(height);
    }
    int kept_channels() const { return channels == 2 ? 4 : channels; }
  };

  Header check_header() const {
    Header header{};
    if (!stbi_info_from_memory(bytes_, size_, &header.width, &header.height, &header.channels)) {
      fail_to_decode();
    }
    if (header.width < 1 || header.height < 1) fail("the image has no pixels");
    if (int64_t{header.width} * header.height > max_texels) fail("the image has too many pixels");
    return header;
  }

  Texture decode_8_bit(const Header& header, TexelEncoding encoding) const {
    const int channel_count = header.kept_channels();
    Texture texture;
    int in_file = 0;
    // Blocks double until they hold the compressed bytes, and those that they unpack to.
    const StbGrowthLimit limit(2 * std::max(header.most_bytes(), static_cast<size_t>(size_)) +
                               4096);
    const DecodedPixels<stbi_uc> pixels(stbi_load_from_memory(
        bytes_, size_, &texture.width, &texture.height, &in_file, channel_count));
    if (limit.is_reached()) fail("a damaged PNG: it unpacks to more than its pixels");
    if (!pixels) fail_to_decode();
    texture.channel_count = channel_count;
    texture.encoding = encoding;
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

  const stbi_uc* bytes_;
  int size_;
};

}  // namespace

bool is_radiance_image(std::string_view bytes) {
  return is_exr(bytes) || bytes.starts_with("#?RADIANCE\n") || bytes.starts_with("#?RGBE\n");
}

Texture decode_image(std::string_view bytes, TexelEncoding encoding) {
  if (bytes.empty()) fail("the image file is empty");
  if (bytes.size() > static_cast<size_t>(std::numeric_limits<int>::max())) {
    fail("the image file is too large");
  }
  if (is_exr(bytes)) return decode_whole_exr(bytes);
  if (!has_sound_huffman_tables(bytes)) fail("a damaged JPEG: too many Huffman codes");
  if (!has_sound_pnm_header(bytes)) fail("a PNM too large, or of more than 8 bits");
  if (!has_sound_hdr_runs(bytes)) fail("a damaged HDR: rows that end too early");
  if (!has_sound_png_chunks(bytes)) fail("a damaged PNG: the file ends within a chunk");
  return StbDecoder(bytes).decode(encoding);
}

}  // namespace tracer
