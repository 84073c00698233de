// SPDX-License-Identifier: MIT
#include "tracer/render/develop.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace tracer {
namespace {

/// Whether x lies at or above the value halfway between `code` - 1 and `code` on the exact curve.
/// The power 2.4 is avoided: x^5 against ((c + 0.055) / 1.055)^12. [IEC 61966-2-1]
constexpr bool is_at_least_code(float x, int code) {
  const double encoded = (code - 0.5) / 255;
  if (encoded <= 0.04045) return x * 12.92 >= encoded;
  const double base = (encoded + 0.055) / 1.055;
  const double base3 = base * base * base;
  const double base6 = base3 * base3;
  const double y = x;
  return y * y * y * y * y >= base6 * base6;
}

/// thresholds[c], c >= 1: the least float whose nearest code is c. thresholds[256] is infinity.
constexpr std::array<float, 257> make_thresholds() {
  std::array<float, 257> thresholds{};
  for (int code = 1; code <= 255; ++code) {
    uint32_t below = 0;
    uint32_t at_least = std::bit_cast<uint32_t>(1.0f);
    while (at_least - below > 1) {
      const uint32_t middle = below + (at_least - below) / 2;
      (is_at_least_code(std::bit_cast<float>(middle), code) ? at_least : below) = middle;
    }
    thresholds[static_cast<size_t>(code)] = std::bit_cast<float>(at_least);
  }
  thresholds[256] = std::numeric_limits<float>::infinity();
  return thresholds;
}

constexpr std::array<float, 257> thresholds = make_thresholds();

// Floats from 2^-13 to 1 by exponent and 7 bits of mantissa: no bucket holds two thresholds.
constexpr int bucket_shift = 23 - 7;
constexpr uint32_t first_bucket = std::bit_cast<uint32_t>(0x1p-13f) >> bucket_shift;
constexpr uint32_t end_bucket = std::bit_cast<uint32_t>(1.0f) >> bucket_shift;

/// The code of each bucket's least float.
constexpr std::array<uint8_t, end_bucket - first_bucket> make_bucket_codes() {
  std::array<uint8_t, end_bucket - first_bucket> codes{};
  int code = 0;
  for (uint32_t i = 0; i < codes.size(); ++i) {
    const float least = std::bit_cast<float>((first_bucket + i) << bucket_shift);
    while (least >= thresholds[static_cast<size_t>(code) + 1]) ++code;
    codes[i] = static_cast<uint8_t>(code);
  }
  return codes;
}

constexpr auto bucket_codes = make_bucket_codes();

/// encode_srgb for inlining, without branches, as noise is not to be predicted: the bits of floats
/// are ordered as integers, negative ones below all others.
inline uint8_t nearest_code(float linear) {
  constexpr int32_t least = std::bit_cast<int32_t>(0x1p-13f);
  constexpr int32_t most = std::bit_cast<int32_t>(1.0f) - 1;
  const int32_t bits = std::clamp(std::bit_cast<int32_t>(linear), least, most);
  const size_t below = bucket_codes[(static_cast<uint32_t>(bits) >> bucket_shift) - first_bucket];
  const size_t code =
      below + static_cast<size_t>(std::bit_cast<float>(bits) >= thresholds[below + 1]);
  const bool is_number = !std::isnan(linear);
  return static_cast<uint8_t>(code * static_cast<size_t>(is_number));
}

/// 2^x from +, * and powers of two, so that files have the same bytes everywhere.
float exp2_portable(double x) {
  const double whole = std::floor(x + 0.5);
  const double power = (x - whole) * std::numbers::ln2;
  double series = 1;
  for (int i = 15; i >= 1; --i) series = 1 + power / i * series;
  return static_cast<float>(std::ldexp(series, static_cast<int>(whole)));
}

}  // namespace

uint8_t encode_srgb(float linear) {
  return nearest_code(linear);
}

void develop(std::span<const Vec3f> radiance, double exposure, std::span<Rgba8> out) {
  assert(radiance.size() == out.size());
  const float scale = exp2_portable(std::clamp(exposure, -100.0, 100.0));
  for (size_t i = 0; i < radiance.size(); ++i) {
    const Vec3f& pixel = radiance[i];
    out[i] = {nearest_code(pixel.x * scale), nearest_code(pixel.y * scale),
              nearest_code(pixel.z * scale), 255};
  }
}

}  // namespace tracer
