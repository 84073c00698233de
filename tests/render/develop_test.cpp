// SPDX-License-Identifier: MIT
#include "tracer/render/develop.h"

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace tracer {
namespace {

/// [IEC 61966-2-1], in long double.
uint8_t exact_code(float linear) {
  const long double x = linear;
  const long double encoded =
      x <= 0.0031308L ? 12.92L * x : 1.055L * std::pow(x, 1 / 2.4L) - 0.055L;
  return static_cast<uint8_t>(std::floor(255 * encoded + 0.5L));
}

TEST(EncodeSrgb, is_the_nearest_code_for_floats_of_every_exponent_and_mantissa) {
  // Every 16th of the 2^30 floats in [0, 1) would take minutes; every 509th meets all exponents.
  const uint32_t end = std::bit_cast<uint32_t>(1.0f);
  for (uint32_t bits = 0; bits < end; bits += 509) {
    const auto x = std::bit_cast<float>(bits);
    ASSERT_EQ(encode_srgb(x), exact_code(x)) << x;
  }
}

TEST(EncodeSrgb, is_exact_on_both_sides_of_every_step) {
  float x = 0;
  for (int code = 1; code <= 255; ++code) {
    // The least float of the code, by the exact curve.
    uint32_t below = std::bit_cast<uint32_t>(x);
    uint32_t at_least = std::bit_cast<uint32_t>(1.0f);
    while (at_least - below > 1) {
      const uint32_t middle = below + (at_least - below) / 2;
      (exact_code(std::bit_cast<float>(middle)) >= code ? at_least : below) = middle;
    }
    x = std::bit_cast<float>(at_least);
    for (uint32_t bits = at_least - 1000; bits < at_least + 1000; ++bits) {
      ASSERT_EQ(encode_srgb(std::bit_cast<float>(bits)), bits < at_least ? code - 1 : code);
    }
  }
}

TEST(EncodeSrgb, takes_what_is_no_colour) {
  EXPECT_EQ(encode_srgb(-0.0f), 0);
  EXPECT_EQ(encode_srgb(-1.0f), 0);
  EXPECT_EQ(encode_srgb(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(encode_srgb(-std::numeric_limits<float>::infinity()), 0);
  EXPECT_EQ(encode_srgb(std::numeric_limits<float>::infinity()), 255);
  EXPECT_EQ(encode_srgb(1.0f), 255);
  EXPECT_EQ(encode_srgb(1e30f), 255);
  EXPECT_EQ(encode_srgb(std::numeric_limits<float>::denorm_min()), 0);
}

TEST(Develop, exposure_multiplies_by_powers_of_two) {
  const std::vector<Vec3f> radiance = {{0.05f, 0.1f, 0.2f}, {0, 1, 2}, {NAN, -1, INFINITY}};
  std::vector<Rgba8> out(radiance.size());
  for (const double exposure : {0.0, 1.0, -3.0, 0.5, -0.25, 19.75, -20.0}) {
    develop(radiance, exposure, out);
    const auto scale = static_cast<float>(std::exp2(exposure));
    for (size_t i = 0; i < out.size(); ++i) {
      EXPECT_EQ(out[i].r, encode_srgb(radiance[i].x * scale)) << exposure;
      EXPECT_EQ(out[i].g, encode_srgb(radiance[i].y * scale)) << exposure;
      EXPECT_EQ(out[i].b, encode_srgb(radiance[i].z * scale)) << exposure;
      EXPECT_EQ(out[i].a, 255);
    }
  }
}

}  // namespace
}  // namespace tracer
