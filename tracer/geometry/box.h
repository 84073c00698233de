// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <utility>

#include "tracer/base/vectors.h"
#include "tracer/geometry/ray.h"

namespace tracer {

/// Axis-aligned box [min, max]; a new one is empty, so that extending it by a point gives that
/// point. Flat boxes are boxes.
struct Box {
  Vec3f min{std::numeric_limits<float>::infinity()};
  Vec3f max{-std::numeric_limits<float>::infinity()};

  void extend(const Vec3f& point);
  void extend(const Box& other);

  bool is_empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  bool contains(const Box& other) const;
  /// Finite for every box with finite corners.
  Vec3f center() const { return 0.5f * min + 0.5f * max; }
  Vec3d extent() const { return Vec3d(max) - Vec3d(min); }
  /// 0, 1 or 2; the lowest of equals.
  int longest_axis() const;
  /// Half the surface area, in double so that it stays finite for every finite box.
  double half_area() const;

  /// Distances, in lengths of the direction, at which the line through the ray enters and leaves
  /// the box; the entry is negative where the origin lies inside. (FLT_MAX, -FLT_MAX) where the ray
  /// [0, inf) misses. Conservative: entry is rounded down and exit up by more than all rounding in
  /// here and in the t of a Hit, so no hit on what the box contains is ever lost, directions with
  /// zero components and origins in a face included. Slabs [Kay 1986], padded as [Ize 2013].
  std::pair<double, double> intersect(const Ray& ray) const;
};

}  // namespace tracer
