// SPDX-License-Identifier: MIT
#include "tracer/scene/jpeg_tables.h"

#include <cstddef>

namespace tracer {
namespace {

constexpr int start_of_image = 0xd8;
constexpr int huffman_tables = 0xc4;
constexpr int start_of_scan = 0xda;
constexpr int most_codes = 256;

class JpegReader {
 public:
  explicit JpegReader(std::string_view bytes) : bytes_(bytes) {}

  bool is_sound() {
    if (byte_at(0) != 0xff || next_marker() != start_of_image) return true;
    while (at_ < bytes_.size()) {
      const int marker = next_marker();
      if (marker == start_of_scan) return is_sound_behind();
      if (marker == huffman_tables && !has_sound_tables(at_)) return false;
      at_ += segment_length(at_);
    }
    return true;
  }

 private:
  /// 0 beyond the end.
  int byte_at(size_t at) const {
    return at < bytes_.size() ? static_cast<unsigned char>(bytes_[at]) : 0;
  }
  /// With its own two bytes.
  size_t segment_length(size_t at) const {
    return static_cast<size_t>(byte_at(at)) * 256 + static_cast<size_t>(byte_at(at + 1));
  }

  /// Passes what is no marker, and a marker, which any number of fill bytes may come before.
  int next_marker() {
    while (at_ < bytes_.size() && byte_at(at_) != 0xff) ++at_;
    while (byte_at(at_) == 0xff) ++at_;
    return byte_at(at_++);
  }

  bool is_sound_behind() const {
    for (size_t at = bytes_.find('\xff', at_); at != bytes_.npos;
         at = bytes_.find('\xff', at + 1)) {
      if (byte_at(at + 1) == huffman_tables && !has_sound_tables(at + 2)) return false;
    }
    return true;
  }

  /// Of a segment whose length stands at `at`: a byte for the table's place, the counts of codes of
  /// 1 to 16 bits, and a byte a code.
  bool has_sound_tables(size_t at) const {
    const size_t end = at + segment_length(at);
    at += 2;
    while (at < end && at < bytes_.size()) {
      int code_count = 0;
      for (size_t bits = 1; bits <= 16; ++bits) code_count += byte_at(at + bits);
      if (code_count > most_codes) return false;
      at += 17 + static_cast<size_t>(code_count);
    }
    return true;
  }

  std::string_view bytes_;
  size_t at_ = 0;
};

}  // namespace

bool has_sound_huffman_tables(std::string_view bytes) {
  return JpegReader(bytes).is_sound();
}

}  // namespace tracer
