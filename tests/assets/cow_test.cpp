// SPDX-License-Identifier: MIT
// The committed cow is the mesh that other tests and the first picture rely on.
#include <array>
#include <fstream>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tracer/base/vectors.h"

namespace tracer {
namespace {

struct Cow {
  std::vector<Vec3d> points, normals;
  std::vector<std::array<size_t, 3>> triangles;
  std::map<std::string, size_t> triangle_counts;  // of each material
};

/// Reads what make_cow writes: v, vn, usemtl, and faces of three "point//normal" with equal
/// indices.
Cow read_cow() {
  Cow cow;
  std::string material;
  std::ifstream file(BOXWOOD_SOURCE_DIR "/assets/cow.obj");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "v" || keyword == "vn") {
      Vec3d value;
      words >> value.x >> value.y >> value.z;
      (keyword == "v" ? cow.points : cow.normals).push_back(value);
    } else if (keyword == "usemtl") {
      words >> material;
    } else if (keyword == "f") {
      std::array<size_t, 3> corners;
      for (size_t& corner : corners) {
        std::string word;
        words >> word;
        corner = std::stoul(word) - 1;
      }
      cow.triangles.push_back(corners);
      ++cow.triangle_counts[material];
    }
  }
  return cow;
}

const Cow& cow() {
  static const Cow read = read_cow();
  return read;
}

std::array<Vec3d, 3> corner_points(const std::array<size_t, 3>& triangle) {
  return {cow().points.at(triangle[0]), cow().points.at(triangle[1]), cow().points.at(triangle[2])};
}

/// Along the outward normal, twice the area long.
Vec3d doubled_area(const std::array<size_t, 3>& triangle) {
  const auto [a, b, c] = corner_points(triangle);
  return glm::cross(b - a, c - a);
}

/// How often each directed edge is walked.
std::map<std::pair<size_t, size_t>, int> directed_edges() {
  std::map<std::pair<size_t, size_t>, int> edges;
  for (const auto& triangle : cow().triangles) {
    for (int i = 0; i < 3; ++i) ++edges[{triangle[i], triangle[(i + 1) % 3]}];
  }
  return edges;
}

TEST(Cow, has_some_6000_triangles) {
  EXPECT_GE(cow().triangles.size(), 5500u);
  EXPECT_LE(cow().triangles.size(), 6500u);
  EXPECT_EQ(cow().points.size(), cow().normals.size());
}

TEST(Cow, is_watertight_with_every_edge_walked_once_each_way) {
  const auto edges = directed_edges();
  ASSERT_FALSE(edges.empty());
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
}

TEST(Cow, is_one_ball_without_handles) {
  std::vector<size_t> parents(cow().points.size());
  std::iota(parents.begin(), parents.end(), size_t{0});
  const auto root = [&](size_t point) {
    while (parents[point] != point) point = parents[point] = parents[parents[point]];
    return point;
  };
  for (const auto& [edge, count] : directed_edges()) parents[root(edge.first)] = root(edge.second);
  std::set<size_t> roots;
  for (size_t point = 0; point < parents.size(); ++point) roots.insert(root(point));
  EXPECT_EQ(roots.size(), 1u);
  EXPECT_EQ(2 * cow().points.size(), cow().triangles.size() + 4);  // Euler: V - E + F = 2
}

TEST(Cow, has_no_two_vertices_at_one_place) {
  std::set<std::array<double, 3>> places;
  for (const Vec3d& point : cow().points) places.insert({point.x, point.y, point.z});
  EXPECT_EQ(places.size(), cow().points.size());
}

TEST(Cow, is_oriented_outward_and_as_big_as_a_cow) {
  double volume = 0.0;
  for (const auto& triangle : cow().triangles) {
    const auto [a, b, c] = corner_points(triangle);
    volume += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  EXPECT_GT(volume, 0.4);  // cubic metres
  EXPECT_LT(volume, 0.8);
}

TEST(Cow, stands_on_the_ground_facing_x) {
  Vec3d lower = cow().points.at(0), upper = lower;
  size_t sole_count = 0;
  for (const Vec3d& point : cow().points) {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
    sole_count += point.y == 0.0;
  }
  EXPECT_EQ(lower.y, 0.0);
  EXPECT_GE(sole_count, 12u);  // three points at least under each of four hooves
  EXPECT_GT(upper.x - lower.x, 2.0);
  EXPECT_LT(upper.x - lower.x, 2.5);
  EXPECT_GT(upper.x, -lower.x);
  EXPECT_LT(upper.z - lower.z, upper.y);
}

TEST(Cow, has_no_slivers) {
  for (const auto& triangle : cow().triangles) {
    const auto [a, b, c] = corner_points(triangle);
    const double edges = glm::dot(b - a, b - a) + glm::dot(c - b, c - b) + glm::dot(a - c, a - c);
    const double quality = 2.0 * std::sqrt(3.0) * glm::length(doubled_area(triangle)) / edges;
    EXPECT_GT(quality, 0.1) << "1 is equilateral; at " << a.x << ' ' << a.y << ' ' << a.z;
  }
}

TEST(Cow, has_unit_normals_that_follow_its_facets) {
  std::vector<Vec3d> means(cow().points.size(), Vec3d(0.0));
  for (const auto& triangle : cow().triangles) {
    for (const size_t corner : triangle) means[corner] += doubled_area(triangle);
  }
  for (size_t i = 0; i < means.size(); ++i) {
    EXPECT_NEAR(glm::length(cow().normals[i]), 1.0, 2e-4);
    EXPECT_GT(glm::dot(cow().normals[i], glm::normalize(means[i])), 0.79);
  }
}

TEST(Cow, wears_every_material_that_its_library_defines) {
  std::set<std::string> defined;
  std::ifstream file(BOXWOOD_SOURCE_DIR "/assets/cow.mtl");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("newmtl ")) defined.insert(line.substr(7));
  }
  EXPECT_EQ(defined.size(), cow().triangle_counts.size());
  for (const auto& [material, count] : cow().triangle_counts) {
    EXPECT_TRUE(defined.contains(material)) << material;
  }
  EXPECT_GT(cow().triangle_counts.at("hide_white"), cow().triangle_counts.at("eye"));
}

}  // namespace
}  // namespace tracer
