// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "tracer/base/vectors.h"

namespace tracer {

/// v at unit length, or `fallback` where v is zero or not finite. Neither overflows nor underflows.
inline Vec3d unit_or(const Vec3d& v, const Vec3d& fallback) {
  const double square = glm::dot(v, v);
  if (square > 0x1p-900 && square < 0x1p900) return v * (1 / std::sqrt(square));
  const double scale = max_abs(v);
  if (!(scale > 0) || !is_finite(v)) return fallback;
  return glm::normalize(v / scale);
}

/// Two unit vectors that make a right-handed frame with the unit vector z [Duff 2017].
struct Tangents {
  Vec3d x;
  Vec3d y;
};
inline Tangents tangents_of(const Vec3d& z) {
  const double sign = std::copysign(1.0, z.z);
  const double a = -1 / (sign + z.z);
  const double b = z.x * z.y * a;
  return {{1 + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}};
}

}  // namespace tracer
