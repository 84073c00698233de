// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/exact_integer.h"
#include "tracer/geometry/ray.h"

namespace tracer {

/// Where the line through a ray meets a triangle, by integers: edges and vertices belong to the
/// triangle, triangles without area and lines in the plane meet nothing.
struct ExactHit {
  bool is_hit;
  long double t;  // may be negative
};

/// All coordinates finite.
inline ExactHit exact_hit(const Ray& ray, const Vec3f& v0, const Vec3f& v1, const Vec3f& v2) {
  const ExactVec3 direction = exact_vec3(Vec3f(0), ray.direction);
  const ExactVec3 a = exact_vec3(ray.origin, v0);
  const ExactVec3 b = exact_vec3(ray.origin, v1);
  const ExactVec3 c = exact_vec3(ray.origin, v2);
  const ExactInteger u = exact_triple(direction, c, b);
  const ExactInteger v = exact_triple(direction, a, c);
  const ExactInteger w = exact_triple(direction, b, a);
  const bool negative = u.sign() < 0 || v.sign() < 0 || w.sign() < 0;
  const bool positive = u.sign() > 0 || v.sign() > 0 || w.sign() > 0;
  if (negative == positive) return {false, 0};
  return {true, exact_triple(a, c, b).scaled_value() / (u + v + w).scaled_value()};
}

}  // namespace tracer
