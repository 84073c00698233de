// SPDX-License-Identifier: MIT
#include "tracer/base/random.h"

#include <array>
#include <bit>

#include <gtest/gtest.h>

namespace tracer {
namespace {

TEST(Random, unit_floats_span_zero_to_just_below_one) {
  EXPECT_EQ(to_unit_float(0), 0.0f);
  EXPECT_LT(to_unit_float(0xffffffffu), 1.0f);
  EXPECT_EQ(to_unit_float(0x80000000u), 0.5f);
}

TEST(Random, one_changed_bit_of_the_lower_half_changes_half_of_all_bits) {
  constexpr int samples = 2000;
  std::array<int64_t, 4> changed_bits{};
  for (uint32_t i = 0; i < samples; ++i) {
    const Words4 a = hash_words({i, 5, 7, 9});
    const Words4 b = hash_words({i ^ (1u << (i % 16)), 5, 7, 9});
    changed_bits[0] += std::popcount(a.x ^ b.x);
    changed_bits[1] += std::popcount(a.y ^ b.y);
    changed_bits[2] += std::popcount(a.z ^ b.z);
    changed_bits[3] += std::popcount(a.w ^ b.w);
  }
  for (const int64_t changed : changed_bits) {
    EXPECT_NEAR(static_cast<double>(changed) / samples, 16, 1.5);
  }
}

TEST(Random, words_are_uniform_over_consecutive_inputs) {
  constexpr int samples = 64000;
  std::array<int, 64> counts{};
  for (uint32_t i = 0; i < samples; ++i) {
    ++counts[static_cast<size_t>(to_unit_float(hash_words({i, 0, 0, 0}).x) * 64)];
  }
  // Chi squared with 63 degrees of freedom: above 120 by chance once in 10^5.
  double chi_squared = 0;
  for (const int count : counts) chi_squared += (count - 1000.0) * (count - 1000.0) / 1000;
  EXPECT_LT(chi_squared, 120);
}

}  // namespace
}  // namespace tracer
