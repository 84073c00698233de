// SPDX-License-Identifier: MIT
#include "tracer/geometry/triangle.h"

#include <gtest/gtest.h>

#include "tests/support/exact_hit.h"
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

testing::AssertionResult is_exact(const Ray& ray, const Triangle& triangle) {
  const ExactHit exact = exact_hit(ray, triangle.v0, triangle.v1, triangle.v2);
  const auto hit = intersect(ray, triangle);
  if (hit.has_value() != (exact.is_hit && exact.t >= 0)) {
    return testing::AssertionFailure() << (hit ? "a false hit" : "a lost hit");
  }
  if (!hit) return testing::AssertionSuccess();
  if (std::abs(hit->t - exact.t) > 0x1p-32L * std::abs(exact.t)) {
    return testing::AssertionFailure() << "t " << hit->t << " is not " << exact.t;
  }
  if (!(hit->u >= 0 && hit->v >= 0 && hit->u + hit->v <= 1)) {
    return testing::AssertionFailure() << "weights " << hit->u << ' ' << hit->v;
  }
  return testing::AssertionSuccess();
}

TEST(Triangle, agrees_with_long_integers_on_random_rays) {
  RandomSource random(1);
  int hits = 0;
  for (int i = 0; i < trials; ++i) {
    const Triangle triangle{random.vector(-1, 1), random.vector(-1, 1), random.vector(-1, 1)};
    const Vec3f origin = random.vector(-3, 3);
    const Ray ray{.origin = origin, .direction = random.vector(-1, 1) - origin};
    ASSERT_TRUE(is_exact(ray, triangle)) << i;
    hits += intersect(ray, triangle).has_value();
  }
  EXPECT_GT(hits, trials / 100);
}

// On a small lattice rays through edges and vertices, rays in the plane, and triangles without
// area are common.
TEST(Triangle, agrees_with_long_integers_on_lattice_points) {
  RandomSource random(2);
  for (int i = 0; i < 2 * trials; ++i) {
    const Triangle triangle{random.lattice(-3, 3), random.lattice(-3, 3), random.lattice(-3, 3)};
    const Ray ray{.origin = random.lattice(-3, 3), .direction = random.lattice(-2, 2)};
    if (ray.direction == Vec3f(0)) continue;
    ASSERT_TRUE(is_exact(ray, triangle)) << i;
  }
}

TEST(Triangle, agrees_with_long_integers_when_aimed_at_edges_and_vertices) {
  RandomSource random(3);
  for (int i = 0; i < trials; ++i) {
    const float distance = std::exp2(random.between(-6, 20));
    const Triangle triangle{random.vector(-1, 1), random.vector(-1, 1), random.vector(-1, 1)};
    const Vec3f origin = random.vector(-distance, distance);
    const Vec3f on_edge = glm::mix(triangle.v0, triangle.v1, random.unit());
    ASSERT_TRUE(is_exact({.origin = origin, .direction = on_edge - origin}, triangle)) << i;
    ASSERT_TRUE(is_exact({.origin = origin, .direction = triangle.v2 - origin}, triangle)) << i;
    ASSERT_TRUE(is_exact({.origin = on_edge, .direction = random.vector(-1, 1)}, triangle)) << i;
    ASSERT_TRUE(is_exact({.origin = origin, .direction = triangle.v1 - triangle.v0}, triangle));
  }
}

TEST(Triangle, agrees_with_long_integers_on_slivers_and_grazing_rays) {
  RandomSource random(4);
  for (int i = 0; i < trials; ++i) {
    const Vec3f v0 = random.vector(-1, 1);
    const Vec3f v1 = random.vector(-1, 1);
    const float thickness = std::exp2(random.between(-30, 0));
    const Triangle triangle{v0, v1, glm::mix(v0, v1, 0.4f) + thickness * random.vector(-1, 1)};
    const Vec3f inside = (triangle.v0 + triangle.v1 + triangle.v2) / 3.0f;
    const Vec3f along = triangle.v1 - triangle.v0;
    const Vec3f direction = along + thickness * random.vector(-1, 1);
    ASSERT_TRUE(is_exact({.origin = inside - direction, .direction = direction}, triangle)) << i;
    ASSERT_TRUE(is_exact({.origin = random.vector(-9, 9), .direction = direction}, triangle)) << i;
  }
}

TEST(Triangle, agrees_with_long_integers_on_any_finite_floats) {
  RandomSource random(5);
  const auto vector = [&] {
    const float x = random.finite_bits();
    const float y = random.finite_bits();
    return Vec3f(x, y, random.finite_bits());
  };
  for (int i = 0; i < trials; ++i) {
    const Triangle triangle{vector(), vector(), vector()};
    const Vec3f origin = vector();
    ASSERT_TRUE(is_exact({.origin = origin, .direction = vector()}, triangle)) << i;
    const Vec3f toward = 0.5f * triangle.v0 + 0.25f * triangle.v1 + 0.25f * triangle.v2;
    const Vec3f direction = 0.5f * toward - 0.5f * origin;
    if (direction == Vec3f(0)) continue;
    ASSERT_TRUE(is_exact({.origin = origin, .direction = direction}, triangle)) << i;
    ASSERT_TRUE(is_exact({.origin = Vec3f(0), .direction = triangle.v0 + Vec3f(1e-38f)}, triangle))
        << i;
  }
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

TEST(Triangle, a_fan_around_a_vertex_lets_no_ray_through) {
  RandomSource random(7);
  for (int trial = 0; trial < trials; ++trial) {
    const Vec3f center = random.vector(-1, 1);
    Vec3f rim[6];
    for (int i = 0; i < 6; ++i) {
      const float angle = (static_cast<float>(i) + 0.5f * random.unit()) * 1.0472f;
      rim[i] = center + Vec3f(std::cos(angle), std::sin(angle), 0.2f * random.unit());
    }
    const Vec3f origin = center + Vec3f(random.between(-1, 1), random.between(-1, 1), 50);
    const Vec3f on_spoke = glm::mix(center, rim[trial % 6], 0.9f * random.unit());
    for (const Vec3f& target : {center, on_spoke}) {
      const Ray ray{.origin = origin, .direction = target - origin};
      bool is_hit = false;
      for (int i = 0; i < 6; ++i) {
        is_hit = is_hit || intersect(ray, {center, rim[i], rim[(i + 1) % 6]});
      }
      ASSERT_TRUE(is_hit) << trial;
    }
  }
}

}  // namespace
}  // namespace tracer
