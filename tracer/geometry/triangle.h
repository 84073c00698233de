// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "tracer/geometry/ray.h"

namespace tracer {

struct TriangleHit {
  double t = 0;
  double u = 0;  // weight of v1
  double v = 0;  // weight of v2
};

/// Where the ray, over t_min <= t <= t_max, meets the triangle v0 v1 v2. The verdict is exact:
/// edges and vertices belong to the triangle, so nothing passes between two triangles that share
/// them. Rays in the triangle's plane, triangles without area and vertices that are not finite are
/// never hit. t is within 2^-32 relative of the exact distance and a function of the ray and the
/// triangle alone. Double precision with a forward error bound decides; where it cannot,
/// expansions do [Shewchuk 1997].
std::optional<TriangleHit> intersect_triangle(const Ray& ray, const Vec3f& v0, const Vec3f& v1,
                                              const Vec3f& v2) noexcept;

}  // namespace tracer
