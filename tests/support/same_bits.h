// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

#include "tracer/geometry/ray.h"

namespace tracer {

/// Tells 0 from -0, and equal NaNs from others.
inline bool are_same_bits(const Hit& a, const Hit& b) {
  const auto same = [](double x, double y) {
    return std::bit_cast<uint64_t>(x) == std::bit_cast<uint64_t>(y);
  };
  return a.primitive == b.primitive && same(a.t, b.t) && same(a.u, b.u) && same(a.v, b.v);
}

}  // namespace tracer
