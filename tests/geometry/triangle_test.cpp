// SPDX-License-Identifier: MIT
#include "tracer/geometry/triangle.h"

#include <gtest/gtest.h>

#include "tests/support/random_source.h"

namespace tracer {
namespace {

constexpr int trials = 20000;

struct Triangle {
  Vec3f v0, v1, v2;
};

std::optional<TriangleHit> intersect(const Ray& ray, const Triangle& triangle) {
  return intersect_triangle(ray, triangle.v0, triangle.v1, triangle.v2);
}

TEST(Triangle, one_unit_in_the_last_place_beside_an_edge_is_a_miss) {
  const Triangle triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto straight_down = [](float x, float y) {
    return Ray{.origin = {x, y, 1}, .direction = {0, 0, -1}};
  };
  EXPECT_TRUE(intersect(straight_down(0.5f, 0), triangle));
  EXPECT_FALSE(intersect(straight_down(0.5f, -std::numeric_limits<float>::denorm_min()), triangle));
  EXPECT_TRUE(intersect(straight_down(0.5f, 0.5f), triangle));
  EXPECT_FALSE(intersect(straight_down(0.5f, std::nextafter(0.5f, 1.0f)), triangle));
}

TEST(Triangle, both_orientations_are_hit_at_the_same_distance) {
  RandomSource random(6);
  for (int i = 0; i < trials; ++i) {
    const Triangle front{random.vector(-1, 1), random.vector(-1, 1), random.vector(-1, 1)};
    const Triangle back{front.v0, front.v2, front.v1};
    const Ray ray{.origin = random.vector(-3, 3), .direction = random.vector(-1, 1)};
    const auto hit = intersect(ray, front);
    const auto hit_of_back = intersect(ray, back);
    ASSERT_EQ(hit.has_value(), hit_of_back.has_value());
    if (hit) {
      EXPECT_EQ(hit->t, hit_of_back->t);
    }
  }
}

TEST(Triangle, weights_give_back_the_point) {
  const Triangle triangle{{0, 0, 2}, {4, 0, 2}, {0, 4, 2}};
  const auto hit = intersect({.origin = {1, 2, 0}, .direction = {0, 0, 0.5f}}, triangle);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 4);
  EXPECT_EQ(hit->u, 0.25);
  EXPECT_EQ(hit->v, 0.5);
}

TEST(Triangle, weights_stay_precise_on_a_tiny_triangle_far_away) {
  const Triangle triangle{{0, 0, 1e6f}, {1, 0, 1e6f}, {0, 1, 1e6f}};
  const Ray ray{.origin = {0.25f, 0.5f, -1e6f}, .direction = {0, 0, 1}};
  const auto hit = intersect(ray, triangle);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->u, 0.25, 1e-9);
  EXPECT_NEAR(hit->v, 0.5, 1e-9);
}

TEST(Triangle, the_ends_of_the_range_belong_to_it) {
  const Triangle triangle{{-1, -1, 3}, {1, -1, 3}, {0, 1, 3}};
  const auto hit_between = [&](double t_min, double t_max) {
    return intersect({.direction = {0, 0, 1}, .t_min = t_min, .t_max = t_max}, triangle)
        .has_value();
  };
  EXPECT_TRUE(hit_between(3, 3));
  EXPECT_FALSE(hit_between(0, std::nextafter(3.0, 0.0)));
  EXPECT_FALSE(hit_between(std::nextafter(3.0, 4.0), 9));
}

TEST(Triangle, an_origin_in_the_triangle_is_hit_at_exactly_zero) {
  const Triangle triangle{{-1, -1, 0.1f}, {1, -1, 0.1f}, {0, 1, 0.1f}};
  const auto hit = intersect({.origin = {0, 0, 0.1f}, .direction = {0.3f, 0.1f, 1}}, triangle);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 0);
}

TEST(Triangle, vertices_that_are_not_finite_are_never_hit) {
  const Ray ray{.origin = {0.2f, 0.2f, -1}, .direction = {0, 0, 1}};
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
        -std::numeric_limits<float>::infinity()}) {
    for (int corner = 0; corner < 3; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        Vec3f vertices[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        vertices[corner][axis] = bad;
        EXPECT_FALSE(intersect_triangle(ray, vertices[0], vertices[1], vertices[2]));
      }
    }
  }
}

TEST(Triangle, rays_that_are_not_finite_hit_nothing) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
        -std::numeric_limits<float>::infinity()}) {
    for (int axis = 0; axis < 3; ++axis) {
      Ray ray{.origin = {0.2f, 0.2f, -1}, .direction = {0, 0, 1}};
      ray.direction[axis] = bad;
      EXPECT_FALSE(intersect_triangle(ray, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
      ray = {.origin = {0.2f, 0.2f, -1}, .direction = {0, 0, 1}};
      ray.origin[axis] = bad;
      EXPECT_FALSE(intersect_triangle(ray, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    }
  }
}

}  // namespace
}  // namespace tracer
