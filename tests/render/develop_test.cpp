// SPDX-License-Identifier: MIT
#include "tracer/render/develop.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace tracer {
namespace {

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
