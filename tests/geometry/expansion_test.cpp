// SPDX-License-Identifier: MIT
#include "tracer/geometry/expansion.h"

#include <gtest/gtest.h>

#include "tests/support/random_source.h"

namespace tracer {
namespace {

double wide_double(RandomSource& random) {
  return std::ldexp(random.between(-1, 1) + random.unit() * 0x1p-26, random.integer(-60, 60));
}

TEST(Expansion, two_sum_loses_nothing) {
  RandomSource random(1);
  for (int i = 0; i < 100000; ++i) {
    const double a = wide_double(random);
    const double b = std::ldexp(a, -random.integer(0, 9)) * random.between(-2, 2);
    const auto [value, error] = two_sum(a, b);
    EXPECT_EQ(value, a + b);
    // 64 bits hold the sum of two doubles so close in magnitude.
    EXPECT_EQ(static_cast<long double>(value) + error, static_cast<long double>(a) + b);
  }
}

TEST(Expansion, two_product_loses_nothing) {
  RandomSource random(2);
  for (int i = 0; i < 100000; ++i) {
    const double a = wide_double(random);
    const double b = wide_double(random);
    const auto [value, error] = two_product(a, b);
    EXPECT_EQ(value, a * b);
    EXPECT_EQ(error, std::fma(a, b, -value));
  }
}

TEST(Expansion, what_is_added_and_taken_away_leaves_zero) {
  RandomSource random(3);
  for (int trial = 0; trial < 2000; ++trial) {
    std::array<double, 20> values;
    Expansion<40> sum;
    for (double& value : values) sum.add(value = wide_double(random));
    for (const double value : values) sum.add(-value);
    EXPECT_EQ(sum.size(), 0);
    EXPECT_EQ(sum.sign(), 0);
    EXPECT_EQ(sum.estimate(), 0);
  }
}

TEST(Expansion, sign_survives_cancellation) {
  Expansion<4> sum;
  sum.add(1);
  sum.add(-0x1p-200);
  sum.add(-1);
  EXPECT_EQ(sum.sign(), -1);
  EXPECT_EQ(sum.estimate(), -0x1p-200);
}

TEST(Expansion, terms_stay_nonzero_and_at_least_halve) {
  RandomSource random(4);
  for (int trial = 0; trial < 2000; ++trial) {
    Expansion<30> sum;
    for (int i = 0; i < 30; ++i) sum.add(wide_double(random));
    for (int i = 0; i < sum.size(); ++i) EXPECT_NE(sum[i], 0);
    for (int i = 1; i < sum.size(); ++i) EXPECT_LE(std::abs(sum[i - 1]), std::abs(sum[i]) / 2);
  }
}

TEST(Expansion, products_are_exact) {
  // (2^60 + 1)(2^60 - 1) - 2^120 = -1
  Expansion<2> above, below;
  above.add(0x1p60), above.add(1);
  below.add(0x1p60), below.add(-1);
  auto product = exact_product(above, below);
  EXPECT_EQ(product.sign(), 1);
  product.add(-0x1p120);
  EXPECT_EQ(product.estimate(), -1);
}

TEST(Expansion, differences_of_floats_of_any_magnitude_are_exact) {
  auto difference = exact_difference(3e38f, 1e-45f);
  EXPECT_EQ(difference.size(), 2);
  difference.add(-static_cast<double>(3e38f));
  EXPECT_EQ(difference.estimate(), -static_cast<double>(1e-45f));
}

}  // namespace
}  // namespace tracer
