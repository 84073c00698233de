// SPDX-License-Identifier: MIT
#include "tracer/scene/png_chunks.h"

#include <cstddef>

namespace tracer {
namespace {

constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
constexpr size_t frame_bytes = 12;  // a chunk's length, type and checksum

size_t big_endian(std::string_view bytes) {
  size_t value = 0;
  for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

}  // namespace

bool has_sound_png_chunks(std::string_view bytes) {
  if (!bytes.starts_with(signature)) return true;
  bytes.remove_prefix(signature.size());
  while (bytes.size() >= frame_bytes) {
    const size_t length = big_endian(bytes.substr(0, 4));
    if (length > bytes.size() - frame_bytes) return false;
    if (bytes.substr(4, 4) == "IEND") return true;
    bytes.remove_prefix(length + frame_bytes);
  }
  return false;
}

}  // namespace tracer
