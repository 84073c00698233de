// SPDX-License-Identifier: MIT
#include "tracer/bvh/uniform_lines.h"

#include <cmath>

#include "tracer/base/random.h"

namespace tracer {
namespace {

constexpr uint32_t seed = 0x6c696e65;

int face_axis(const Vec3d& extent, double random) {
  const double x = extent.y * extent.z;
  const double y = extent.z * extent.x;
  const double z = extent.x * extent.y;
  const double chosen = random * (x + y + z);
  if (chosen < x) return 0;
  return chosen < x + y ? 1 : 2;
}

// Uniform in the open unit disk.
Vec2d disk_point(uint32_t index) {
  for (uint32_t attempt = 0;; ++attempt) {
    const Words4 words = hash_words({index, attempt, seed, 1});
    const Vec2d point(2.0 * to_unit_float(words.x) - 1, 2.0 * to_unit_float(words.y) - 1);
    if (glm::dot(point, point) < 1) return point;
  }
}

}  // namespace

// Lines enter a convex body uniformly over its surface, and by the cosine to its normal.
Ray uniform_line(const Box& box, uint32_t index) {
  const Words4 words = hash_words({index, 0, seed, 0});
  const Vec3d extent = box.extent();
  const int axis = face_axis(extent, to_unit_float(words.x));
  const bool is_far_face = (words.x & 1) != 0;
  const Vec2d across = disk_point(index);
  const double inward = std::sqrt(1 - glm::dot(across, across));
  Vec3d origin =
      Vec3d(box.min) +
      Vec3d(to_unit_float(words.y), to_unit_float(words.z), to_unit_float(words.w)) * extent;
  Vec3d direction;
  origin[axis] = (is_far_face ? box.max : box.min)[axis];
  direction[axis] = is_far_face ? -inward : inward;
  direction[(axis + 1) % 3] = across.x;
  direction[(axis + 2) % 3] = across.y;
  return {.origin = Vec3f(origin), .direction = Vec3f(direction)};
}

}  // namespace tracer
