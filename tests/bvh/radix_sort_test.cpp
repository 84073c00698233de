// SPDX-License-Identifier: MIT
#include "tracer/bvh/build/radix_sort.h"

#include <gtest/gtest.h>

#include "tests/support/random_source.h"

namespace tracer {
namespace {

std::vector<CurveKey> random_keys(uint32_t count, uint32_t distinct_codes, int code_bits) {
  RandomSource random(count);
  std::vector<CurveKey> keys(count);
  for (uint32_t i = 0; i < count; ++i) {
    const float position = random.vector(0, 1).x;
    const auto code = static_cast<uint32_t>(position * static_cast<float>(distinct_codes));
    keys[i] = {std::min(code, distinct_codes - 1) * ((1u << code_bits) / distinct_codes), i};
  }
  return keys;
}

bool are_same(CurveKey a, CurveKey b) {
  return a.code == b.code && a.primitive == b.primitive;
}

TEST(RadixSort, is_the_stable_sort_of_any_number_of_keys) {
  for (const int code_bits : {24, 30}) {
    for (const uint32_t count : {1u, 2u, 2047u, 2048u, 32768u, 32769u, 200000u}) {
      for (const uint32_t distinct_codes : {1u, 7u, 1u << 20, 1u << 24}) {
        std::vector<CurveKey> expected = random_keys(count, distinct_codes, code_bits);
        std::vector<CurveKey> keys = expected;
        std::vector<CurveKey> scratch(count);
        const auto sorted = radix_sort(keys, scratch, code_bits, Progress());
        std::ranges::stable_sort(expected, {}, &CurveKey::code);
        EXPECT_TRUE(std::ranges::equal(sorted, expected, are_same))
            << count << " keys, " << distinct_codes << " codes of " << code_bits << " bits";
      }
    }
  }
}

TEST(RadixSort, stops_when_asked) {
  std::vector<CurveKey> keys = random_keys(200000, 1u << 24, 30);
  std::vector<CurveKey> scratch(keys.size());
  Progress progress;
  progress.request_stop();
  EXPECT_THROW(radix_sort(keys, scratch, 30, progress), Cancelled);
}

}  // namespace
}  // namespace tracer
