// SPDX-License-Identifier: MIT
// Four of something, turned into rows of four lanes.
#pragma once

#include <array>
#include <cstring>

#include "tracer/geometry/box4.h"

namespace tracer {

inline Float4 load(const float* four) {
  Float4 lanes;
  std::memcpy(&lanes, four, sizeof lanes);
  return lanes;
}

inline void store(float* four, Float4 lanes) {
  std::memcpy(four, &lanes, sizeof lanes);
}

inline Float4 splat_last(Float4 lanes) {
  return __builtin_shufflevector(lanes, lanes, 3, 3, 3, 3);
}

inline void transpose(std::array<Float4, 4>& rows) {
  const auto& [a, b, c, d] = rows;
  const Float4 low_ab = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  const Float4 low_cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Float4 high_ab = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Float4 high_cd = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  rows = {__builtin_shufflevector(low_ab, low_cd, 0, 1, 4, 5),
          __builtin_shufflevector(low_ab, low_cd, 2, 3, 6, 7),
          __builtin_shufflevector(high_ab, high_cd, 0, 1, 4, 5),
          __builtin_shufflevector(high_ab, high_cd, 2, 3, 6, 7)};
}

}  // namespace tracer
