// SPDX-License-Identifier: MIT
#include "tracer/geometry/clip_polygon.h"

namespace tracer {
namespace {

void add_corner(Polygon& polygon, const Vec3d& corner) {
  if (polygon.count < static_cast<int>(polygon.corners.size())) {
    polygon.corners[static_cast<size_t>(polygon.count++)] = corner;
  }
}

void find_bounds(Polygon& polygon) {
  if (polygon.count == 0) return;
  polygon.min = polygon.max = polygon.corners[0];
  for (int i = 1; i < polygon.count; ++i) {
    polygon.min = glm::min(polygon.min, polygon.corners[static_cast<size_t>(i)]);
    polygon.max = glm::max(polygon.max, polygon.corners[static_cast<size_t>(i)]);
  }
}

// Keeps what has side * (x[axis] - plane) >= 0.
void cut(Polygon& polygon, int axis, double plane, double side) {
  Polygon kept;
  for (int i = 0; i < polygon.count; ++i) {
    const Vec3d& a = polygon.corners[static_cast<size_t>(i)];
    const Vec3d& b = polygon.corners[static_cast<size_t>(i + 1 < polygon.count ? i + 1 : 0)];
    const double from_a = side * (a[axis] - plane);
    const double from_b = side * (b[axis] - plane);
    if (from_a >= 0) add_corner(kept, a);
    if ((from_a < 0 && from_b > 0) || (from_a > 0 && from_b < 0)) {
      Vec3d crossing = a + (from_a / (from_a - from_b)) * (b - a);
      crossing[axis] = plane;
      add_corner(kept, crossing);
    }
  }
  find_bounds(kept);
  polygon = kept;
}

}  // namespace

Polygon make_triangle(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  Polygon triangle;
  for (const Vec3f& corner : {a, b, c}) add_corner(triangle, Vec3d(corner));
  find_bounds(triangle);
  return triangle;
}

Polygon clip(const Polygon& polygon, const Box& box) {
  Polygon part = polygon;
  for (int axis = 0; axis < 3; ++axis) {
    if (part.count > 0 && part.min[axis] < box.min[axis]) cut(part, axis, box.min[axis], 1);
    if (part.count > 0 && part.max[axis] > box.max[axis]) cut(part, axis, box.max[axis], -1);
  }
  return part;
}

double area(const Polygon& polygon) {
  Vec3d doubled(0);
  for (int i = 2; i < polygon.count; ++i) {
    doubled += glm::cross(polygon.corners[static_cast<size_t>(i - 1)] - polygon.corners[0],
                          polygon.corners[static_cast<size_t>(i)] - polygon.corners[0]);
  }
  return 0.5 * glm::length(doubled);
}

}  // namespace tracer
