// SPDX-License-Identifier: MIT
#include "tracer/scene/hdr_runs.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "tracer/obj/parse_number.h"

namespace tracer {
namespace {

constexpr int64_t narrowest_encoded = 8;
constexpr int64_t widest_encoded = 32767;
constexpr int64_t largest_size = std::numeric_limits<int>::max();
constexpr size_t row_head = 4;  // bytes
constexpr int channel_count = 4;

std::string_view take_line(std::string_view& bytes) {
  const std::string_view line = bytes.substr(0, bytes.find('\n'));
  bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
  return line;
}

/// The number behind `sign_and_axis`, both of which are taken; 0 where they are not there.
int64_t take_size(std::string_view& text, std::string_view sign_and_axis) {
  if (!text.starts_with(sign_and_axis)) return 0;
  text.remove_prefix(sign_and_axis.size());
  const Parsed<int64_t> size = parse_int(text.data(), text.data() + text.size());
  text.remove_prefix(static_cast<size_t>(size.end - text.data()));
  return size.value;
}

/// Takes one channel of a row: runs of one value, and of values one by one.
bool take_channel(std::string_view& bytes, int64_t width) {
  while (width > 0) {
    if (bytes.empty()) return false;
    const auto code = static_cast<unsigned char>(bytes.front());
    const bool is_repeated = code > 128;
    const int texel_count = is_repeated ? code - 128 : code;
    const size_t size = 1 + (is_repeated ? 1 : static_cast<size_t>(texel_count));
    if (texel_count == 0 || texel_count > width || size > bytes.size()) return false;
    bytes.remove_prefix(size);
    width -= texel_count;
  }
  return true;
}

bool is_encoded(std::string_view row) {
  return row[0] == 2 && row[1] == 2 && (row[2] & 0x80) == 0;
}

bool has_sound_rows(std::string_view bytes, int64_t width, int64_t height) {
  if (width < narrowest_encoded || width > widest_encoded) return true;
  for (int64_t row = 0; row < height; ++row) {
    if (bytes.size() < row_head) return false;
    // From a row on that is not encoded, texels stand one by one.
    if (!is_encoded(bytes)) return true;
    bytes.remove_prefix(row_head);
    for (int channel = 0; channel < channel_count; ++channel) {
      if (!take_channel(bytes, width)) return false;
    }
  }
  return true;
}

}  // namespace

bool has_sound_hdr_runs(std::string_view bytes) {
  if (!bytes.starts_with("#?RADIANCE\n") && !bytes.starts_with("#?RGBE\n")) return true;
  while (!bytes.empty()) {
    const std::string_view line = take_line(bytes);
    if (line.empty() || line.front() == '\0') break;
  }
  std::string_view sizes = take_line(bytes);
  const int64_t height = take_size(sizes, "-Y ");
  const int64_t width = take_size(sizes, " +X ");
  const bool has_size = height > 0 && height <= largest_size && width > 0 && width <= largest_size;
  return has_size && has_sound_rows(bytes, width, height);
}

}  // namespace tracer
