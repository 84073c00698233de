// SPDX-License-Identifier: MIT
#include "tracer/geometry/box.h"

#include <cfloat>

#include <gtest/gtest.h>

#include "tests/support/random_source.h"
#include "tracer/geometry/triangle.h"

namespace tracer {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float denormal = std::numeric_limits<float>::denorm_min();

bool is_hit(const Box& box, const Ray& ray) {
  const auto [entry, exit] = box.intersect(ray);
  return entry <= exit;
}

TEST(Box, is_empty_until_extended_and_then_just_that_point) {
  Box box;
  EXPECT_TRUE(box.is_empty());
  box.extend(Vec3f(1, 2, 3));
  EXPECT_FALSE(box.is_empty());
  EXPECT_EQ(box.min, Vec3f(1, 2, 3));
  EXPECT_EQ(box.max, Vec3f(1, 2, 3));
}

TEST(Box, extended_by_a_box_holds_both_and_no_more) {
  Box box{{0, 0, 0}, {1, 1, 1}};
  const Box other{{-1, 0.5f, 0}, {0.5f, 2, 0}};
  box.extend(other);
  EXPECT_TRUE(box.contains(other));
  EXPECT_EQ(box.min, Vec3f(-1, 0, 0));
  EXPECT_EQ(box.max, Vec3f(1, 2, 1));
}

TEST(Box, extended_by_an_empty_box_stays_as_it_is) {
  Box box{{0, 0, 0}, {1, 1, 1}};
  box.extend(Box());
  EXPECT_EQ(box.min, Vec3f(0));
  EXPECT_EQ(box.max, Vec3f(1));
  EXPECT_TRUE(Box().contains(Box()));
  EXPECT_FALSE(Box().contains(box));
}

TEST(Box, measures_of_the_largest_finite_box_are_finite) {
  const Box box{Vec3f(-FLT_MAX), Vec3f(FLT_MAX)};
  EXPECT_TRUE(is_finite(box.center()));
  EXPECT_TRUE(is_finite(box.extent()));
  EXPECT_TRUE(std::isfinite(box.half_area()));
  EXPECT_EQ(Box().half_area(), 0);
}

TEST(Box, longest_axis_is_the_lowest_of_equals) {
  EXPECT_EQ((Box{{0, 0, 0}, {1, 1, 1}}).longest_axis(), 0);
  EXPECT_EQ((Box{{0, 0, 0}, {1, 2, 2}}).longest_axis(), 1);
  EXPECT_EQ((Box{{0, 0, 0}, {1, 2, 3}}).longest_axis(), 2);
}

TEST(Box, a_miss_is_flt_max_and_minus_flt_max) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  for (const Ray& ray : {Ray{.origin{2, 2, 2}, .direction{1, 0, 0}},
                         Ray{.origin{2, 0.5f, 0.5f}, .direction{1, 0, 0}},
                         Ray{.origin{2, 2, 2}, .direction{-1, -1, -3}}}) {
    const auto [entry, exit] = box.intersect(ray);
    EXPECT_EQ(entry, FLT_MAX);
    EXPECT_EQ(exit, -FLT_MAX);
  }
}

TEST(Box, entry_and_exit_are_those_of_the_slabs) {
  const Box box{{1, -1, -1}, {3, 1, 1}};
  const auto [entry, exit] = box.intersect({.origin{0, 0, 0}, .direction{0.5f, 0, 0}});
  EXPECT_NEAR(entry, 2, 2 * 0x1p-29);
  EXPECT_NEAR(exit, 6, 6 * 0x1p-29);
}

TEST(Box, entry_is_negative_from_inside) {
  const Box box{{-1, -1, -1}, {1, 1, 1}};
  const auto [entry, exit] = box.intersect({.origin{0, 0, 0}, .direction{0, -2, 0}});
  EXPECT_NEAR(entry, -0.5, 1e-9);
  EXPECT_NEAR(exit, 0.5, 1e-9);
}

TEST(Box, an_origin_in_a_face_hits_along_the_face_with_either_zero) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  for (int axis = 0; axis < 3; ++axis) {
    for (const float face : {0.0f, 1.0f}) {
      for (const float zero : {0.0f, -0.0f}) {
        for (const float along : {1.0f, -1.0f}) {
          Vec3f origin(0.5f);
          Vec3f direction(zero);
          origin[axis] = face;
          direction[(axis + 1) % 3] = along;
          EXPECT_TRUE(is_hit(box, {.origin = origin, .direction = direction}));
          origin[(axis + 1) % 3] = 0.5f - 7 * along;
          EXPECT_TRUE(is_hit(box, {.origin = origin, .direction = direction}));
          origin[axis] = std::nextafter(face, face == 0 ? -1.0f : 2.0f);
          EXPECT_FALSE(is_hit(box, {.origin = origin, .direction = direction}));
        }
      }
    }
  }
}

TEST(Box, edges_and_corners_belong_to_it) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  for (const float x : {0.0f, 1.0f}) {
    for (const float y : {0.0f, 1.0f}) {
      EXPECT_TRUE(is_hit(box, {.origin{x, y, -3}, .direction{0, -0.0f, 1}}));
      EXPECT_TRUE(is_hit(box, {.origin{x, y, 1}, .direction{0, 0, 1}}));
      EXPECT_TRUE(is_hit(box, {.origin{x, y, 0}, .direction{x - 0.5f, y - 0.5f, -0.25f}}));
    }
  }
}

TEST(Box, a_flat_box_is_hit_head_on_and_within_its_plane) {
  const Box box{{0, 0, 5}, {1, 1, 5}};
  EXPECT_TRUE(is_hit(box, {.origin{0.5f, 0.5f, 0}, .direction{0, 0, 1}}));
  EXPECT_TRUE(is_hit(box, {.origin{-1, 0.5f, 5}, .direction{1, 0, 0}}));
  EXPECT_TRUE(is_hit(box, {.origin{0.5f, 0.5f, 5}, .direction{0, 0, -1}}));
  EXPECT_FALSE(is_hit(box, {.origin{-1, 0.5f, 6}, .direction{1, 0, 0}}));
}

TEST(Box, a_point_is_hit_by_a_ray_through_it) {
  const Box box{Vec3f(0.1f), Vec3f(0.1f)};
  EXPECT_TRUE(is_hit(box, {.origin{0, 0, 0}, .direction{0.1f, 0.1f, 0.1f}}));
  EXPECT_TRUE(is_hit(box, {.origin = Vec3f(0.1f), .direction{0, 0, 1}}));
}

TEST(Box, an_empty_box_is_never_hit) {
  for (const Vec3f& direction : {Vec3f(1, 0, 0), Vec3f(-1, 2, -3), Vec3f(0, -0.0f, denormal)}) {
    EXPECT_FALSE(is_hit(Box(), {.origin{0, 0, 0}, .direction = direction}));
  }
}

TEST(Box, an_infinite_box_is_always_hit) {
  const Box box{Vec3f(-infinity), Vec3f(infinity)};
  for (const Vec3f& direction : {Vec3f(1, 0, 0), Vec3f(-1, 2, -3), Vec3f(0, -0.0f, denormal)}) {
    const auto [entry, exit] = box.intersect({.origin{3e38f, 0, -5}, .direction = direction});
    EXPECT_LT(entry, 0);
    EXPECT_GT(exit, 0);
  }
}

TEST(Box, denormal_directions_reach_boxes) {
  const Box box{{-1, -1, 9}, {1, 1, 10}};
  EXPECT_TRUE(is_hit(box, {.origin{0, 0, 0}, .direction{0, 0, denormal}}));
  EXPECT_FALSE(is_hit(box, {.origin{0, 0, 0}, .direction{denormal, 0, denormal}}));
}

// The contract that traversal rests on: whatever intersect_triangle finds lies between entry and
// exit, of a box that has no room to spare.
void expect_hit_within_box(const Ray& ray, const Vec3f& v0, const Vec3f& v1, const Vec3f& v2) {
  const auto hit = intersect_triangle(ray, v0, v1, v2);
  if (!hit) return;
  Box box;
  for (const Vec3f& vertex : {v0, v1, v2}) box.extend(vertex);
  const auto [entry, exit] = box.intersect(ray);
  ASSERT_LE(entry, hit->t);
  ASSERT_GE(exit, hit->t);
}

TEST(Box, a_hit_on_a_triangle_lies_between_entry_and_exit_of_its_bounds) {
  RandomSource random(1);
  for (int i = 0; i < 200000 && !testing::Test::HasFatalFailure(); ++i) {
    const float distance = std::exp2(random.between(-10, 40));
    const float size = std::exp2(random.between(-20, 2));
    const Vec3f center = random.vector(-1, 1);
    const Vec3f v0 = center + random.vector(-size, size);
    const Vec3f v1 = center + random.vector(-size, size);
    const Vec3f v2 = center + random.vector(-size, size);
    const Vec3f origin = center + random.vector(-distance, distance);
    expect_hit_within_box({.origin = origin, .direction = v1 - origin}, v0, v1, v2);
    expect_hit_within_box({.origin = origin, .direction = glm::mix(v0, v1, 0.3f) - origin}, v0, v1,
                          v2);
    expect_hit_within_box({.origin = v2, .direction = random.vector(-1, 1)}, v0, v1, v2);
  }
}

TEST(Box, a_hit_on_a_lattice_triangle_lies_between_entry_and_exit_of_its_bounds) {
  RandomSource random(2);
  for (int i = 0; i < 300000 && !testing::Test::HasFatalFailure(); ++i) {
    Vec3f direction = random.lattice(-1, 1);
    if (direction == Vec3f(0)) continue;
    // Zeros of both signs, and directions that are almost none.
    direction *= random.integer(0, 1) == 0 ? -1.0f : denormal;
    expect_hit_within_box({.origin = random.lattice(-2, 2), .direction = direction},
                          random.lattice(-2, 2), random.lattice(-2, 2), random.lattice(-2, 2));
  }
}

}  // namespace
}  // namespace tracer
