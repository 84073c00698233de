// SPDX-License-Identifier: MIT
#include "tracer/scene/srgb_codes.h"

#include <algorithm>

namespace tracer {
namespace {

/// x^2.4 for x in (0, 1], by what every processor rounds alike.
constexpr double power_2_4(double x) {
  // Newton's method for the fifth root of x^2, from above.
  double root = 1;
  for (int i = 0; i < 64; ++i) {
    const double fourth = root * root * root * root;
    root -= (fourth * root - x * x) / (5 * fourth);
  }
  return x * x * root;
}

constexpr std::array<float, 256> make_table(TexelEncoding encoding) {
  std::array<float, 256> table{};
  for (int code = 0; code < 256; ++code) {
    const double encoded = code / 255.0;
    double value = encoded;
    if (encoding == TexelEncoding::srgb) {
      value = encoded <= 0.04045 ? encoded / 12.92 : power_2_4((encoded + 0.055) / 1.055);
    }
    table[static_cast<size_t>(code)] = static_cast<float>(value);
  }
  return table;
}

constexpr std::array<float, 256> srgb_table = make_table(TexelEncoding::srgb);
constexpr std::array<float, 256> linear_table = make_table(TexelEncoding::linear);

}  // namespace

const std::array<float, 256>& decode_table(TexelEncoding encoding) {
  return encoding == TexelEncoding::srgb ? srgb_table : linear_table;
}

uint8_t encode(TexelEncoding encoding, float value) {
  const std::array<float, 256>& table = decode_table(encoding);
  const auto above = std::lower_bound(table.begin(), table.end(), value);
  if (above == table.begin()) return 0;
  if (above == table.end()) return 255;
  const auto nearest = *above - value < value - above[-1] ? above : above - 1;
  return static_cast<uint8_t>(nearest - table.begin());
}

}  // namespace tracer
