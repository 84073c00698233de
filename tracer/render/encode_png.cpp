// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <stdexcept>

#include <stb_image_write.h>

#include "tracer/render/develop.h"
#include "tracer/render/image_formats.h"

namespace tracer {
namespace {

// The signature and IHDR with its length, type and checksum: other chunks follow.
constexpr size_t header_bytes = 8 + 4 + 4 + 13 + 4;

/// CRC-32 as PNG defines it [ISO 15948].
uint32_t crc32(const std::string& bytes) {
  uint32_t crc = 0xffffffffu;
  for (const char byte : bytes) {
    crc ^= static_cast<uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0);
  }
  return ~crc;
}

std::string big_endian(uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  return big_endian(static_cast<uint32_t>(data.size())) + body + big_endian(crc32(body));
}

/// An uncompressed iTXt chunk; the keyword is cut to the 79 bytes that PNG allows.
std::string text_chunk(const std::string& key, const std::string& value) {
  const std::string no_compression_language_or_translation(5 - 1, '\0');
  return chunk("iTXt", key.substr(0, 79) + '\0' + no_compression_language_or_translation + value);
}

void append_bytes(void* out, void* data, int size) {
  static_cast<std::string*>(out)->append(static_cast<const char*>(data), static_cast<size_t>(size));
}

}  // namespace

std::string encode_png(const Image& image, double exposure, const Metadata& metadata) {
  std::vector<Rgba8> pixels(image.pixels.size());
  develop(image.pixels, exposure, pixels);
  std::vector<uint8_t> rgb;
  rgb.reserve(3 * pixels.size());
  for (const Rgba8& pixel : pixels) rgb.insert(rgb.end(), {pixel.r, pixel.g, pixel.b});

  std::string bytes;
  const auto [width, height] = std::array{image.size_px.x, image.size_px.y};
  if (stbi_write_png_to_func(append_bytes, &bytes, width, height, 3, rgb.data(), 3 * width) == 0) {
    throw std::runtime_error("PNG compression failed");
  }
  std::string chunks = chunk("sRGB", std::string(1, '\0'));
  for (const auto& [key, value] : metadata) chunks += text_chunk(key, value);
  bytes.insert(header_bytes, chunks);
  return bytes;
}

}  // namespace tracer
