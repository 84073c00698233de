// SPDX-License-Identifier: MIT
#include "tracer/obj/triangulate.h"

#include <chrono>
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace tracer {
namespace {

constexpr double pi = 3.14159265358979323846;

using Polygon = std::vector<Vec3d>;

std::vector<Vec3u> triangulate(const Polygon& polygon) {
  std::vector<Vec3u> triangles;
  Triangulator().triangulate(polygon, triangles);
  return triangles;
}

Vec3d area_vector(const Polygon& polygon) {
  Vec3d sum(0.0);
  for (size_t i = 0; i < polygon.size(); ++i) {
    sum += glm::cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return sum;
}

/// Every triangle turns as the polygon does, and their areas add up to its own: for a simple
/// polygon that is a tiling.
void expect_tiling(const Polygon& polygon) {
  const std::vector<Vec3u> triangles = triangulate(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  const Vec3d whole = area_vector(polygon);
  const Vec3d normal = whole / glm::length(whole);
  double sum = 0;
  for (const Vec3u& t : triangles) {
    const double area = glm::dot(area_vector({polygon[t.x], polygon[t.y], polygon[t.z]}), normal);
    EXPECT_GT(area, 0) << t.x << ' ' << t.y << ' ' << t.z;
    sum += area;
  }
  EXPECT_NEAR(sum, glm::length(whole), 1e-9 * glm::length(whole));
}

void expect_valid_triples(const Polygon& polygon) {
  const std::vector<Vec3u> triangles = triangulate(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  for (const Vec3u& t : triangles) {
    ASSERT_LT(std::max({t.x, t.y, t.z}), polygon.size());
    EXPECT_TRUE(t.x != t.y && t.y != t.z && t.z != t.x);
  }
}

Polygon reversed(Polygon polygon) {
  std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

/// Into the plane of two skew axes, so that no coordinate is constant.
Polygon tilted(const std::vector<Vec2d>& points) {
  Polygon polygon;
  for (const Vec2d& p : points) {
    polygon.push_back(Vec3d(5, -3, 2) + p.x * Vec3d(0.6, 0.64, 0.48) +
                      p.y * Vec3d(-0.8, 0.48, 0.36));
  }
  return polygon;
}

/// A star around the origin whose radii are random: simple, and concave at about every other
/// corner.
std::vector<Vec2d> random_star(size_t corner_count, uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Vec2d> points;
  for (size_t i = 0; i < corner_count; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(corner_count);
    const double radius = 0.2 + 0.8 * static_cast<double>(random()) / 4294967296.0;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return points;
}

/// Long teeth side by side.
std::vector<Vec2d> comb(size_t tooth_count) {
  std::vector<Vec2d> points;
  for (size_t i = 0; i < tooth_count; ++i) {
    const auto x = static_cast<double>(i);
    const double bulge =
        x * (static_cast<double>(tooth_count) - x) / static_cast<double>(tooth_count);
    points.emplace_back(x, 1.0 + bulge);
    points.emplace_back(x + 0.5, static_cast<double>(tooth_count) + bulge);
  }
  points.emplace_back(static_cast<double>(tooth_count), 0.0);
  points.emplace_back(0.0, 0.0);
  std::reverse(points.begin(), points.end());
  return points;
}

/// A strip wound up: no corner inside is far from the strip's other side.
std::vector<Vec2d> spiral(size_t corner_count) {
  const size_t half = corner_count / 2;
  std::vector<Vec2d> points;
  for (size_t i = 0; i < half; ++i) {
    const double angle = 0.05 * static_cast<double>(i) + 1;
    points.emplace_back(angle * std::cos(angle), angle * std::sin(angle));
  }
  for (size_t i = half; i-- > 0;) {
    const double angle = 0.05 * static_cast<double>(i) + 1;
    points.emplace_back((angle + 2) * std::cos(angle), (angle + 2) * std::sin(angle));
  }
  return points;
}

TEST(Triangulate, a_triangle_is_itself) {
  EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), (std::vector<Vec3u>{{0, 1, 2}}));
}

TEST(Triangulate, a_convex_quad_is_cut_from_its_first_corner) {
  EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}),
            (std::vector<Vec3u>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Triangulate, a_concave_quad_is_cut_at_its_reflex_corner) {
  const Polygon arrow = tilted({{0, 0}, {4, 0}, {1, 1}, {0, 4}});
  for (size_t turn = 0; turn < 4; ++turn) {
    Polygon polygon = arrow;
    std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(turn),
                polygon.end());
    expect_tiling(polygon);
    expect_tiling(reversed(polygon));
  }
}

TEST(Triangulate, concave_polygons_are_tiled_whichever_way_they_lie_and_turn) {
  const std::vector<Vec2d> letter_e = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 2}, {3, 2},
                                       {3, 3}, {1, 3}, {1, 4}, {4, 4}, {4, 5}, {0, 5}};
  expect_tiling(tilted(letter_e));
  expect_tiling(reversed(tilted(letter_e)));
  for (int axis = 0; axis < 3; ++axis) {
    Polygon flat;
    for (const Vec2d& p : letter_e) {
      Vec3d corner(7.0);
      corner[(axis + 1) % 3] = p.x;
      corner[(axis + 2) % 3] = p.y;
      flat.push_back(corner);
    }
    expect_tiling(flat);
    expect_tiling(reversed(flat));
  }
}

TEST(Triangulate, a_thousand_corners_give_998_triangles_none_of_them_flipped) {
  for (uint32_t seed = 0; seed < 20; ++seed) expect_tiling(tilted(random_star(1000, seed)));
  expect_tiling(tilted(comb(499)));
  expect_tiling(tilted(spiral(1000)));
}

TEST(Triangulate, small_random_stars_are_tiled) {
  for (uint32_t seed = 0; seed < 2000; ++seed) {
    const Polygon polygon = tilted(random_star(5 + seed % 12, seed));
    expect_tiling(seed % 2 == 0 ? polygon : reversed(polygon));
  }
}

TEST(Triangulate, corners_on_straight_edges_become_corners_of_triangles_with_area) {
  Polygon square;
  for (int i = 0; i < 4; ++i) square.emplace_back(i, 0, 0);
  for (int i = 0; i < 4; ++i) square.emplace_back(4, i, 0);
  for (int i = 0; i < 4; ++i) square.emplace_back(4 - i, 4, 0);
  for (int i = 0; i < 4; ++i) square.emplace_back(0, 4 - i, 0);
  expect_tiling(square);
}

TEST(Triangulate, a_hole_on_a_bridge_stays_open) {
  // The outer square, a bridge to the inner one, around it the other way, and back.
  const Polygon ring = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 0},
                        {3, 3, 0}, {3, 6, 0}, {6, 6, 0}, {6, 3, 0}, {3, 3, 0}};
  const std::vector<Vec3u> triangles = triangulate(ring);
  ASSERT_EQ(triangles.size(), 8u);
  double sum = 0;
  for (const Vec3u& t : triangles) {
    const Vec3d center = (ring[t.x] + ring[t.y] + ring[t.z]) / 3.0;
    EXPECT_FALSE(center.x > 3 && center.x < 6 && center.y > 3 && center.y < 6);
    const double area = area_vector({ring[t.x], ring[t.y], ring[t.z]}).z / 2;
    EXPECT_GE(area, 0);
    sum += area;
  }
  EXPECT_EQ(sum, 72);
}

TEST(Triangulate, repeated_corners_cost_nothing_but_triangles_without_area) {
  const Polygon polygon = {{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 0, 0},
                           {1, 1, 0}, {2, 2, 0}, {0, 2, 0}, {0, 2, 0}};
  double sum = 0;
  for (const Vec3u& t : triangulate(polygon)) {
    const double area = area_vector({polygon[t.x], polygon[t.y], polygon[t.z]}).z;
    EXPECT_GE(area, 0);
    sum += area;
  }
  EXPECT_EQ(sum, area_vector(polygon).z);
}

TEST(Triangulate, degenerate_polygons_end_in_valid_triples) {
  expect_valid_triples(Polygon(7, Vec3d(1, 2, 3)));
  expect_valid_triples({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}});
  expect_valid_triples({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {0, 1, 0}});
  expect_valid_triples({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}});
  expect_valid_triples({{0, 0, 0}, {1e38, 0, 0}, {1e38, 1e-38, 0}, {0, 1e38, 0}, {-1, 1, 1}});
  expect_valid_triples({{0, 0, 0}, {1e-300, 0, 0}, {1e-300, 1e-300, 0}, {0, 1e-300, 0}, {0, 0, 0}});
  std::mt19937 random(3);
  for (int round = 0; round < 3000; ++round) {
    Polygon polygon(5 + random() % 20);
    for (Vec3d& p : polygon) p = Vec3d(random() % 4, random() % 4, random() % 2);
    expect_valid_triples(polygon);
  }
}

TEST(Triangulate, many_corners_are_tiled_too) {
  expect_tiling(tilted(random_star(30'000, 5)));
  expect_tiling(tilted(comb(15'000)));
  expect_tiling(tilted(spiral(30'000)));
}

std::vector<Vec2d> circle(size_t corner_count) {
  std::vector<Vec2d> points;
  for (size_t i = 0; i < corner_count; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(corner_count);
    points.emplace_back(std::cos(angle), std::sin(angle));
  }
  return points;
}

/// Crosses itself everywhere.
std::vector<Vec2d> tangle(size_t corner_count) {
  std::mt19937 random(4);
  std::vector<Vec2d> points(corner_count);
  for (Vec2d& p : points) p = Vec2d(random(), random());
  return points;
}

TEST(Triangulate, a_million_corners_take_seconds) {
#if defined(__SANITIZE_THREAD__)
  const size_t million = size_t{1} << 15;  // one thread, a hundred times as slow
#else
  const size_t million = size_t{1} << 20;
#endif
  for (const auto& points : {comb(million / 2 - 1), spiral(million), circle(million),
                             random_star(million / 4, 5), tangle(million / 4)}) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(triangulate(tilted(points)).size(), points.size() - 2);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(120));
  }
}

}  // namespace
}  // namespace tracer
