// SPDX-License-Identifier: MIT
#include "tracer/bvh/build/radix_sort.h"

#include <gtest/gtest.h>

#include "tests/support/random_source.h"

namespace tracer {
namespace {

std::vector<CurveKey> random_keys(uint32_t count, uint32_t distinct_codes) {
  RandomSource random(count);
  std::vector<CurveKey> keys(count);
  for (uint32_t i = 0; i < count; ++i) {
    const float position = random.vector(0, 1).x;
    const auto code = static_cast<uint32_t>(position * static_cast<float>(distinct_codes));
    keys[i] = {std::min(code, distinct_codes - 1) * ((1u << 30) / distinct_codes), i};
  }
  return keys;
}

bool are_same(CurveKey a, CurveKey b) {
  return a.code == b.code && a.primitive == b.primitive;
}

TEST(RadixSort, is_the_stable_sort_of_any_number_of_keys) {
  for (const uint32_t count : {1u, 2u, 2047u, 2048u, 32768u, 32769u, 200000u}) {
    for (const uint32_t distinct_codes : {1u, 7u, 1u << 20, 1u << 30}) {
      std::vector<CurveKey> expected = random_keys(count, distinct_codes);
      std::vector<CurveKey> from = expected;
      std::vector<CurveKey> to(count);
      radix_sort(from, to, {0, count}, Progress());
      std::ranges::stable_sort(expected, {}, &CurveKey::code);
      EXPECT_TRUE(std::ranges::equal(to, expected, are_same)) << count << ", " << distinct_codes;
    }
  }
}

TEST(RadixSort, leaves_what_is_outside_of_its_range) {
  for (const uint32_t count : {100u, 5000u}) {
    std::vector<CurveKey> from = random_keys(count, 1u << 30);
    std::vector<CurveKey> to(count, CurveKey{1, 2});
    radix_sort(from, to, {10, count - 10}, Progress());
    for (const uint32_t i : {0u, 9u, count - 10, count - 1}) {
      EXPECT_TRUE(are_same(to[i], {1, 2})) << i;
    }
    EXPECT_TRUE(std::is_sorted(to.begin() + 10, to.end() - 10,
                               [](CurveKey a, CurveKey b) { return a.code < b.code; }));
  }
}

TEST(RadixSort, stops_when_asked) {
  std::vector<CurveKey> from = random_keys(200000, 1u << 30);
  std::vector<CurveKey> to(from.size());
  Progress progress;
  progress.request_stop();
  EXPECT_THROW(radix_sort(from, to, {0, 200000}, progress), Cancelled);
}

}  // namespace
}  // namespace tracer
