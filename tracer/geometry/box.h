// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <utility>

#include "tracer/base/vectors.h"
#include "tracer/geometry/ray.h"

namespace tracer {

/// What every box needs of the same ray, computed once.
struct RaySlabs {
  Vec3d origin;
  Vec3d inverse_direction;  // infinite, and of its sign, where a component is zero

  explicit RaySlabs(const Ray& ray)
      : origin(ray.origin), inverse_direction(1.0 / Vec3d(ray.direction)) {}
};

/// Axis-aligned box [min, max]; a new one is empty, so that extending it by a point gives that
/// point. Flat boxes are boxes.
struct Box {
  Vec3f min{std::numeric_limits<float>::infinity()};
  Vec3f max{-std::numeric_limits<float>::infinity()};

  void extend(const Vec3f& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void extend(const Box& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }

  bool is_empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  bool contains(const Box& other) const;
  /// Finite for every box with finite corners.
  Vec3f center() const { return 0.5f * min + 0.5f * max; }
  Vec3d extent() const { return Vec3d(max) - Vec3d(min); }
  /// 0, 1 or 2; the lowest of equals.
  int longest_axis() const;
  /// Half the surface area, in double so that it stays finite for every finite box.
  double half_area() const {
    if (is_empty()) return 0;
    const Vec3d size = extent();
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }

  /// Distances, in lengths of the direction, at which the line through the ray enters and leaves
  /// the box; the entry is negative where the origin lies inside. (FLT_MAX, -FLT_MAX) where the ray
  /// [0, inf) misses. Conservative: entry is rounded down and exit up by more than all rounding in
  /// here and in the t of a Hit (docs/numerics.md), so no hit on what the box contains is ever
  /// lost, directions with zero components and origins in a face included. Slabs [Kay 1986],
  /// padded as [Ize 2013].
  std::pair<double, double> intersect(const Ray& ray) const { return intersect(RaySlabs(ray)); }
  std::pair<double, double> intersect(const RaySlabs& ray) const;
};

inline std::pair<double, double> Box::intersect(const RaySlabs& ray) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double miss = std::numeric_limits<float>::max();
  constexpr double pad = 0x1p-30;
  double entry = -infinity;
  double exit = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = ray.origin[axis];
    const double inverse = ray.inverse_direction[axis];
    // signbit, not < 0: the reciprocal of -0 is -infinity.
    const bool is_backward = std::signbit(inverse);
    const double near = ((is_backward ? max : min)[axis] - origin) * inverse;
    const double far = ((is_backward ? min : max)[axis] - origin) * inverse;
    // 0 * infinity, an origin in the face of a parallel slab, is NaN: it fails both comparisons
    // and the slab does not constrain the ray.
    entry = near > entry ? near : entry;
    exit = far < exit ? far : exit;
  }
  entry -= std::abs(entry) * pad;
  exit += std::abs(exit) * pad;
  // Infinite entries and exits of a miss turn to NaN above, and fail here.
  if (!(entry <= exit) || exit < 0) return {miss, -miss};
  return {entry, exit};
}

}  // namespace tracer
