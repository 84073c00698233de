// SPDX-License-Identifier: MIT
#include "tracer/scene/pnm_header.h"

#include <algorithm>
#include <cstdint>

namespace tracer {
namespace {

constexpr int64_t largest_size = 999'999'999;
constexpr int64_t largest_sample = 255;

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

void skip_blanks(std::string_view& text) {
  while (!text.empty()) {
    if (text.front() == '#') {
      text.remove_prefix(std::min(text.find_first_of("\r\n"), text.size()));
    } else if (is_space(text.front())) {
      text.remove_prefix(1);
    } else {
      return;
    }
  }
}

/// 0 where there is no number; saturates above largest_size.
int64_t take_number(std::string_view& text) {
  int64_t value = 0;
  while (!text.empty() && text.front() >= '0' && text.front() <= '9') {
    value = std::min(value * 10 + (text.front() - '0'), largest_size + 1);
    text.remove_prefix(1);
  }
  return value;
}

}  // namespace

bool has_sound_pnm_header(std::string_view bytes) {
  if (!bytes.starts_with("P5") && !bytes.starts_with("P6")) return true;
  bytes.remove_prefix(2);
  for (const int64_t limit : {largest_size, largest_size, largest_sample}) {
    skip_blanks(bytes);
    if (take_number(bytes) > limit) return false;
  }
  return true;
}

}  // namespace tracer
