// SPDX-License-Identifier: MIT
#include "tracer/geometry/box.h"

namespace tracer {

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

}  // namespace tracer
