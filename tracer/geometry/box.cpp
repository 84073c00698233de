// SPDX-License-Identifier: MIT
#include "tracer/geometry/box.h"

#include <cfloat>
#include <cmath>

namespace tracer {

void Box::extend(const Vec3f& point) {
  min = glm::min(min, point);
  max = glm::max(max, point);
}

void Box::extend(const Box& other) {
  min = glm::min(min, other.min);
  max = glm::max(max, other.max);
}

bool Box::contains(const Box& other) const {
  if (other.is_empty()) return true;
  for (int axis = 0; axis < 3; ++axis) {
    if (other.min[axis] < min[axis] || other.max[axis] > max[axis]) return false;
  }
  return true;
}

int Box::longest_axis() const {
  const Vec3d size = extent();
  int axis = 0;
  if (size.y > size[axis]) axis = 1;
  if (size.z > size[axis]) axis = 2;
  return axis;
}

double Box::half_area() const {
  if (is_empty()) return 0;
  const Vec3d size = extent();
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

std::pair<double, double> Box::intersect(const Ray& ray) const {
  constexpr std::pair<double, double> miss{FLT_MAX, -FLT_MAX};
  // Three roundings in double (3 * 2^-53) plus the 2^-40 that a Hit's t is allowed.
  constexpr double pad = 0x1p-38;
  double entry = -std::numeric_limits<double>::infinity();
  double exit = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = ray.origin[axis];
    const double inverse = 1.0 / static_cast<double>(ray.direction[axis]);
    // signbit, not < 0: the reciprocal of -0 is -infinity.
    const bool backward = std::signbit(inverse);
    const double near = ((backward ? max : min)[axis] - origin) * inverse;
    const double far = ((backward ? min : max)[axis] - origin) * inverse;
    // 0 * infinity, an origin in the face of a parallel slab, is NaN: it fails both comparisons
    // and the slab does not constrain the ray.
    if (near > entry) entry = near;
    if (far < exit) exit = far;
  }
  entry -= std::abs(entry) * pad;
  exit += std::abs(exit) * pad;
  if (!(entry <= exit) || exit < 0) return miss;
  return {entry, exit};
}

}  // namespace tracer
