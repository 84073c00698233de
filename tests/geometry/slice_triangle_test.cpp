// SPDX-License-Identifier: MIT
#include "tracer/geometry/slice_triangle.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random_source.h"

namespace tracer {
namespace {

using Corners = std::array<Vec3f, 3>;

std::vector<Box> slices(const Corners& corners, int axis, const std::vector<float>& planes) {
  std::vector<Box4> parts(planes.size() + 1);
  slice_triangle(corners, axis, planes, parts);
  std::vector<Box> boxes;
  for (const Box4& part : parts) boxes.push_back(part.box());
  return boxes;
}

TEST(SliceTriangle, gives_the_boxes_of_the_parts) {
  const Corners corners{Vec3f(0, 0, 5), Vec3f(8, 0, 5), Vec3f(0, 4, 5)};
  const std::vector<Box> parts = slices(corners, 0, {2, 4});
  const Box expected[] = {{{0, 0, 5}, {2, 4, 5}}, {{2, 0, 5}, {4, 3, 5}}, {{4, 0, 5}, {8, 2, 5}}};
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(parts[i].contains(expected[i])) << i;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(parts[i].min[axis], expected[i].min[axis], 1e-4) << i;
      EXPECT_NEAR(parts[i].max[axis], expected[i].max[axis], 1e-4) << i;
    }
  }
}

TEST(SliceTriangle, cuts_exactly_at_the_planes_and_keeps_flat_boxes_flat) {
  const Corners corners{Vec3f(0.1f, 0.7f, 5.3f), Vec3f(7.9f, 0.3f, 5.3f), Vec3f(0.3f, 4.1f, 5.3f)};
  const std::vector<Box> parts = slices(corners, 0, {1.7f});
  EXPECT_EQ(parts[0].max.x, 1.7f);
  EXPECT_EQ(parts[1].min.x, 1.7f);
  for (const Box& part : parts) EXPECT_EQ(part.min.z, part.max.z);
}

TEST(SliceTriangle, has_nothing_beyond_the_triangle) {
  const Corners corners{Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0)};
  const std::vector<Box> parts = slices(corners, 0, {-2, -1, 3});
  EXPECT_TRUE(parts[0].is_empty() && parts[1].is_empty() && parts[3].is_empty());
  EXPECT_EQ(parts[2].max, Vec3f(1, 1, 0));
}

// A point of the triangle to within 2^-52, of which the box of its slab must know.
Vec3d point_on(const Corners& corners, double u, double v) {
  return (1 - u - v) * Vec3d(corners[0]) + u * Vec3d(corners[1]) + v * Vec3d(corners[2]);
}

bool contains(const Box& box, const Vec3d& point) {
  bool is_inside = true;
  for (int axis = 0; axis < 3; ++axis) {
    is_inside &= box.min[axis] <= point[axis] && point[axis] <= box.max[axis];
  }
  return is_inside;
}

TEST(SliceTriangle, parts_hold_every_point_at_any_scale_and_place) {
  RandomSource random(1);
  for (const float scale : {1e-30f, 1e-3f, 1.0f, 1e30f, 1e38f}) {
    for (const float offset : {0.0f, 1.0f}) {
      for (int i = 0; i < 500; ++i) {
        Corners corners;
        for (Vec3f& corner : corners) {
          corner = scale * (offset + std::exp2(random.between(-15, 1)) * random.vector(-1, 1));
        }
        const int axis = random.integer(0, 2);
        const float plane = point_on(corners, random.unit(), 0)[axis];
        const std::vector<Box> parts = slices(corners, axis, {plane});
        for (int j = 0; j < 20; ++j) {
          const double u = random.unit();
          const Vec3d point = point_on(corners, u, random.unit() * (1 - u));
          // Where the plane's distance is no more than the point's own rounding, either will do.
          const double distance = point[axis] - plane;
          if (std::abs(distance) < 1e-12 * std::abs(point[axis])) continue;
          EXPECT_TRUE(contains(parts[distance > 0 ? 1 : 0], point)) << scale << ' ' << i;
        }
      }
    }
  }
}

TEST(SliceTriangle, differences_beyond_all_floats_leave_the_whole_edge) {
  const Corners corners{Vec3f(-3e38f, -3e38f, 0), Vec3f(3e38f, 3e38f, 0), Vec3f(3e38f, 3e38f, 1)};
  for (const Box& part : slices(corners, 0, {0})) {
    EXPECT_TRUE(is_finite(part.min) && is_finite(part.max));
    EXPECT_TRUE(part.min.y <= 0 && part.max.y >= 0);
  }
}

}  // namespace
}  // namespace tracer
