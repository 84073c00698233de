// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

#include "tracer/base/vectors.h"

namespace tracer {

/// Points origin + t * direction, t_min <= t <= t_max. The direction need not be unit length; t
/// counts in its lengths. Components are finite, the direction is not zero, t_min >= 0.
struct Ray {
  Vec3f origin{};
  Vec3f direction{};
  double t_min = 0;
  double t_max = std::numeric_limits<double>::infinity();
};

inline constexpr uint32_t no_primitive = 0xffffffffu;

/// The nearest intersection. u and v weigh the triangle's second and third vertex. Where two
/// primitives are met at the same t, the one with the lower index counts.
struct Hit {
  double t = std::numeric_limits<double>::infinity();
  double u = 0;
  double v = 0;
  uint32_t primitive = no_primitive;

  bool is_hit() const { return primitive != no_primitive; }
  bool is_closer_than(const Hit& other) const {
    return t < other.t || (t == other.t && primitive < other.primitive);
  }
};

}  // namespace tracer
