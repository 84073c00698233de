// SPDX-License-Identifier: MIT
#include "tracer/scene/sun_sky.h"

#include <numbers>

#include <gtest/gtest.h>

namespace tracer {
namespace {

constexpr double pi = std::numbers::pi;

TEST(SunSky, the_sun_stands_where_it_is_told_to) {
  const auto noon = make_sun_sky({90, 0});
  EXPECT_NEAR(noon->sun()->direction.y, 1, 1e-12);
  const auto side = make_sun_sky({0, 90});
  EXPECT_NEAR(side->sun()->direction.z, -1, 1e-12);
  const auto high = make_sun_sky({30, 0});
  EXPECT_NEAR(high->sun()->direction.x, std::cos(pi / 6), 1e-12);
  EXPECT_NEAR(high->sun()->direction.y, 0.5, 1e-12);
}

TEST(SunSky, the_zenith_is_as_bright_as_the_model_says) {
  constexpr double turbidity = 3, elevation = 40;
  const double sun_zenith = (90 - elevation) * pi / 180;
  const double chi = (4.0 / 9 - turbidity / 120) * (pi - 2 * sun_zenith);
  const double kilocandelas =
      (4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192;
  const auto sky = make_sun_sky({elevation, 10}, turbidity);
  EXPECT_NEAR(luminance(sky->map().radiance({0, 1, 0})) * 20 / kilocandelas, 1, 0.01);
}

TEST(SunSky, daylight_is_as_bright_as_outdoors) {
  const auto sky = make_sun_sky({60, 0});
  const Sun& sun = *sky->sun();
  const double lux = luminance(sun.radiance) * sun.solid_angle() * sun.direction.y * 20000;
  EXPECT_GT(lux, 60e3);
  EXPECT_LT(lux, 110e3);
  EXPECT_GT(sky->map().power() * 20000, 10e3);
  EXPECT_LT(sky->map().power() * 20000, 150e3);
}

TEST(SunSky, the_sky_is_blue_and_a_low_sun_red) {
  const auto noon = make_sun_sky({70, 0});
  const Vec3d opposite = noon->map().radiance({-0.6, 0.8, 0});
  EXPECT_GT(opposite.z, 1.3 * opposite.x);
  const Vec3d high = noon->sun()->radiance;
  const Vec3d low = make_sun_sky({3, 0})->sun()->radiance;
  EXPECT_GT(low.x / low.z, 2 * (high.x / high.z));
  EXPECT_LT(low.y, 0.5 * high.y);
}

TEST(SunSky, it_is_finite_and_not_negative_at_every_height_of_the_sun) {
  for (int elevation = 0; elevation <= 90; elevation += 5) {
    for (const double turbidity : {2.0, 3.0, 10.0}) {
      const auto sky = make_sun_sky({static_cast<double>(elevation), 45}, turbidity);
      for (const Vec3f& texel : sky->map().image().texels) {
        ASSERT_TRUE(is_finite(texel)) << elevation;
        ASSERT_GE(std::min({texel.x, texel.y, texel.z}), 0) << elevation;
      }
      EXPECT_GT(sky->map().power(), 0);
    }
  }
}

}  // namespace
}  // namespace tracer
