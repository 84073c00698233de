// SPDX-License-Identifier: MIT
#include "tracer/obj/comment_paint.h"

namespace tracer {
namespace {

/// The value of a hexadecimal digit; -1 where it is none.
int hexadecimal_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const int letter = (c | 0x20) - 'a';
  return letter >= 0 && letter < 6 ? letter + 10 : -1;
}

}  // namespace

void read_paint(std::string_view comment, std::vector<uint32_t>& painted) {
  constexpr std::string_view head = "#MRGB ";
  if (!comment.starts_with(head)) return;
  for (std::string_view digits = comment.substr(head.size()); digits.size() >= 8;
       digits.remove_prefix(8)) {
    uint32_t mrgb = 0;
    for (const char c : digits.substr(0, 8)) {
      const int value = hexadecimal_value(c);
      if (value < 0) return;
      mrgb = mrgb * 16 + static_cast<uint32_t>(value);
    }
    painted.push_back(mrgb);
  }
}

}  // namespace tracer
