// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "tracer/base/vectors.h"
#include "tracer/geometry/box.h"

namespace tracer {

/// A convex polygon, or what is left of one: a segment, a point, nothing.
struct Polygon {
  // What six planes leave of a triangle has nine corners; roundings may add some.
  std::array<Vec3d, 16> corners;
  int count = 0;
  Vec3d min{};  // of the corners, when there are any
  Vec3d max{};
};

Polygon make_triangle(const Vec3f& a, const Vec3f& b, const Vec3f& c);

/// The part of the polygon in the closed box, within a few roundings of double
/// [Sutherland 1974].
Polygon clip(const Polygon& polygon, const Box& box);

double area(const Polygon& polygon);

}  // namespace tracer
