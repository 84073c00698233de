// SPDX-License-Identifier: MIT
#include "tracer/geometry/clip_polygon.h"

#include <gtest/gtest.h>

#include "tests/support/random_source.h"

namespace tracer {
namespace {

const Polygon unit_triangle = make_triangle(Vec3f(0), Vec3f(1, 0, 0), Vec3f(0, 1, 0));

double clipped_area(const Polygon& polygon, const Vec3f& min, const Vec3f& max) {
  return area(clip(polygon, {min, max}));
}

TEST(ClipPolygon, what_lies_inside_is_kept_bit_for_bit) {
  const Polygon part = clip(unit_triangle, {Vec3f(0), Vec3f(1)});
  ASSERT_EQ(part.count, 3);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(part.corners[i], unit_triangle.corners[i]);
  EXPECT_EQ(area(part), 0.5);
}

TEST(ClipPolygon, areas_of_parts_are_those_computed_by_hand) {
  EXPECT_EQ(clipped_area(unit_triangle, Vec3f(0.5f, 0, -1), Vec3f(1)), 0.125);
  EXPECT_EQ(clipped_area(unit_triangle, Vec3f(0), Vec3f(0.5f)), 0.25);
  EXPECT_EQ(clipped_area(unit_triangle, Vec3f(0), Vec3f(0.75f, 0.75f, 0)), 0.5 - 2 * 0.03125);
  EXPECT_EQ(clipped_area(unit_triangle, Vec3f(0.5f), Vec3f(1)), 0);
}

TEST(ClipPolygon, nothing_is_left_of_what_lies_outside) {
  EXPECT_EQ(clip(unit_triangle, {Vec3f(2), Vec3f(3)}).count, 0);
  // Inside the triangle's box, beyond its long side.
  EXPECT_EQ(clip(unit_triangle, {Vec3f(0.75f, 0.75f, -1), Vec3f(1)}).count, 0);
}

TEST(ClipPolygon, what_touches_is_left_as_a_point_or_a_segment_without_area) {
  const Polygon corner = clip(unit_triangle, {Vec3f(1, 0, 0), Vec3f(2, 1, 1)});
  EXPECT_EQ(corner.count, 1);
  EXPECT_EQ(area(corner), 0);
  const Polygon side = clip(unit_triangle, {Vec3f(-1, 0, 0), Vec3f(0, 1, 1)});
  EXPECT_EQ(side.count, 2);
  EXPECT_EQ(area(side), 0);
}

TEST(ClipPolygon, a_hexagon_is_cut_through_the_middle_of_a_cube) {
  // The plane x + y + z = 1.5 cuts the unit cube in a regular hexagon of side sqrt(1/2).
  const Polygon large = make_triangle(Vec3f(-8.5f, 5, 5), Vec3f(5, -8.5f, 5), Vec3f(5, 5, -8.5f));
  const Polygon hexagon = clip(large, {Vec3f(0), Vec3f(1)});
  EXPECT_EQ(hexagon.count, 6);
  EXPECT_NEAR(area(hexagon), 0.75 * std::sqrt(3.0), 1e-14);
}

TEST(ClipPolygon, the_eight_parts_of_a_box_add_up_to_the_whole) {
  RandomSource random(1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3f a = random.vector(-1, 1);
    const Vec3f b = random.vector(-1, 1);
    const Polygon triangle = make_triangle(a, b, random.vector(-1, 1));
    const Vec3f middle = random.vector(-0.5f, 0.5f);
    double sum = 0;
    for (int octant = 0; octant < 8; ++octant) {
      Box box{Vec3f(-1), Vec3f(1)};
      for (int axis = 0; axis < 3; ++axis) {
        ((octant >> axis & 1) != 0 ? box.min : box.max)[axis] = middle[axis];
      }
      const Polygon part = clip(triangle, box);
      EXPECT_LE(part.count, 9);
      for (int corner = 0; corner < part.count; ++corner) {
        const Vec3d& point = part.corners[static_cast<size_t>(corner)];
        EXPECT_EQ(glm::clamp(point, Vec3d(box.min), Vec3d(box.max)), point);
      }
      sum += area(part);
    }
    EXPECT_NEAR(sum, area(triangle), 1e-12);
  }
}

}  // namespace
}  // namespace tracer
