// SPDX-License-Identifier: MIT
#include "tracer/base/trigonometry.h"

#include <random>

#include <gtest/gtest.h>

namespace tracer {
namespace {

constexpr long double pi = std::numbers::pi_v<long double>;

TEST(Trigonometry, cosine_and_sine_of_turns_are_good_to_1e_15) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-2, 2);
  for (int i = 0; i < 1'000'000; ++i) {
    const double turns = i < 1000 ? i / 1000.0 : uniform(random);
    const CosSin result = cos_sin_of_turns(turns);
    ASSERT_NEAR(result.cos, static_cast<double>(std::cos(2 * pi * turns)), 1e-15) << turns;
    ASSERT_NEAR(result.sin, static_cast<double>(std::sin(2 * pi * turns)), 1e-15) << turns;
  }
}

TEST(Trigonometry, whole_quarters_of_a_turn_are_exact) {
  for (int turn = -3; turn <= 3; ++turn) {
    EXPECT_EQ(cos_sin_of_turns(turn).cos, 1);
    EXPECT_EQ(cos_sin_of_turns(turn).sin, 0);
    EXPECT_EQ(cos_sin_of_turns(turn + 0.25).cos, 0);
    EXPECT_EQ(cos_sin_of_turns(turn + 0.25).sin, 1);
    EXPECT_EQ(cos_sin_of_turns(turn + 0.5).cos, -1);
    EXPECT_EQ(cos_sin_of_turns(turn + 0.75).sin, -1);
  }
}

TEST(Trigonometry, tangents_are_relatively_good_from_narrow_to_wide) {
  for (const double degrees : {1e-6, 1e-3, 1.0, 39.6, 90.0, 179.0, 179.9}) {
    const auto expected = static_cast<double>(std::tan(degrees / 360 * pi));
    EXPECT_NEAR(tan_half_degrees(degrees), expected, 1e-12 * expected) << degrees;
  }
}

TEST(Trigonometry, angles_of_vectors_are_good_to_1e_15_at_every_scale) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 200'000; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 400) - 200);
    const double x = uniform(random) * scale;
    const double y = std::abs(uniform(random)) * scale;
    const auto expected = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
    ASSERT_NEAR(angle_of(x, y), static_cast<double>(expected), 2e-15) << x << ' ' << y;
  }
  EXPECT_EQ(angle_of(1, 0), 0);
  EXPECT_EQ(angle_of(0, 0), 0);
  EXPECT_NEAR(angle_of(-1, 0), std::numbers::pi, 1e-15);
  EXPECT_NEAR(angle_of(0, 1), std::numbers::pi / 2, 1e-15);
}

TEST(Trigonometry, quick_turns_are_good_to_1e_9_all_around) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 1'000'000; ++i) {
    const double turns = i < 1000 ? i / 1000.0 : 0.5 + 0.5 * uniform(random);
    const double size = std::exp(10 * uniform(random));
    const double x = size * static_cast<double>(std::cos(2 * pi * turns));
    const double y = size * static_cast<double>(std::sin(2 * pi * turns));
    const double apart = std::abs(quick_turns_of(x, y) - turns);
    ASSERT_LT(std::min(apart, std::abs(apart - 1)), 1e-9) << turns;
  }
  EXPECT_EQ(quick_turns_of(0, 0), 0);
  EXPECT_EQ(quick_turns_of(0, 1), 0.25);
  EXPECT_EQ(quick_turns_of(-1, 0), 0.5);
  EXPECT_EQ(quick_turns_of(0, -1), 0.75);
}

TEST(Trigonometry, powers_of_e_are_good_to_1e_15) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-40, 40);
  for (int i = 0; i < 1'000'000; ++i) {
    const double x = uniform(random);
    ASSERT_NEAR(exp_of(x) / static_cast<double>(std::exp(static_cast<long double>(x))), 1, 1e-15);
  }
  EXPECT_EQ(exp_of(0), 1);
  EXPECT_EQ(exp_of(-1000), 0);
}

}  // namespace
}  // namespace tracer
