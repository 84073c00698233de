// SPDX-License-Identifier: MIT
#include <limits>

#include <gtest/gtest.h>

#include "tests/assets/obj_faces.h"

namespace tracer {
namespace {

class Teapot : public testing::Test {
 protected:
  const ObjFaces teapot = read_obj_faces(BOXWOOD_SOURCE_DIR "/assets/teapot.obj");
};

double distance_to_segment(const Vector& p, const Vector& a, const Vector& b) {
  const double along = dot(p - a, b - a) / std::max(dot(b - a, b - a), 1e-300);
  return length(p - (a + std::clamp(along, 0.0, 1.0) * (b - a)));
}

double distance_to_triangle(const Vector& p, const std::array<Vector, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Vector normal = cross(b - a, c - a);
  bool projects_inside = dot(normal, normal) > 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < 3; ++i) {
    const Vector &from = corners[i], &to = corners[(i + 1) % 3];
    projects_inside = projects_inside && dot(cross(to - from, p - from), normal) >= 0;
    nearest = std::min(nearest, distance_to_segment(p, from, to));
  }
  return projects_inside ? std::abs(dot(p - a, normal)) / length(normal) : nearest;
}

double distance_to_surface(const Vector& p, const ObjFaces& obj) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const ObjFace& face : obj.faces) {
    for (size_t i = 2; i < face.corners.size(); ++i) {
      const Vector& a = obj.positions[face.corners[0]];
      const Vector& b = obj.positions[face.corners[i - 1]];
      const Vector& c = obj.positions[face.corners[i]];
      if (length(p - a) - std::max(length(b - a), length(c - a)) >= nearest) continue;
      nearest = std::min(nearest, distance_to_triangle(p, {a, b, c}));
    }
  }
  return nearest;
}

double farthest_vertex(const ObjFaces& from, const ObjFaces& to) {
  double farthest = 0;
  for (const Vector& p : from.positions) farthest = std::max(farthest, distance_to_surface(p, to));
  return farthest;
}

// Per part: 32 patches of 10 x 12 cells, less one triangle a cell where a row is a point.
TEST_F(Teapot, has_all_32_patches) {
  std::map<std::string, int> triangle_counts;
  for (const ObjFace& face : teapot.faces) {
    ASSERT_EQ(face.corners.size(), 3u);
    ++triangle_counts[face.group];
  }
  EXPECT_EQ(triangle_counts, (std::map<std::string, int>{{"lid", 8 * 240 - 4 * 12},
                                                         {"body", 16 * 240 - 4 * 12},
                                                         {"handle", 4 * 240},
                                                         {"spout", 4 * 240}}));
}

// The lid's edge, the mouth of the body, and both ends of the handle and the spout.
TEST_F(Teapot, is_welded_and_oriented_with_six_open_ends) {
  const std::map<Edge, int> edges = directed_edges(teapot);
  for (const auto& [edge, count] : edges) ASSERT_EQ(count, 1) << edge.first << ' ' << edge.second;
  EXPECT_EQ(loop_lengths(boundary(edges)), (std::vector<size_t>{24, 24, 24, 24, 48, 48}));
}

TEST_F(Teapot, has_no_slivers) {
  for (const ObjFace& face : teapot.faces) {
    double longest = 0;
    for (size_t i = 0; i < 3; ++i) {
      longest = std::max(longest, length(teapot.positions[face.corners[i]] -
                                         teapot.positions[face.corners[(i + 1) % 3]]));
    }
    EXPECT_GT(length(area_vector(teapot, face)), 0.05 * longest * longest);
  }
}

// At the lip of the spout the surface turns by some 65 degrees within a triangle.
TEST_F(Teapot, normals_are_unit_and_on_the_outer_side_of_each_triangle) {
  ASSERT_EQ(teapot.normals.size(), teapot.positions.size());
  for (const Vector& normal : teapot.normals) ASSERT_NEAR(length(normal), 1, 1e-4);
  for (const ObjFace& face : teapot.faces) {
    EXPECT_EQ(face.normals, face.corners);
    const Vector outward = area_vector(teapot, face);
    const double least_cosine = face.group == "spout" ? 0.35 : 0.8;
    for (const size_t corner : face.normals) {
      EXPECT_GT(dot(teapot.normals[corner], outward), least_cosine * length(outward));
    }
  }
  double volume_six_times = 0;
  for (const ObjFace& face : teapot.faces) {
    volume_six_times += dot(teapot.positions[face.corners[0]], area_vector(teapot, face));
  }
  EXPECT_GT(volume_six_times, 0);
}

TEST_F(Teapot, stands_on_the_ground_and_is_as_high_and_long_as_newells) {
  Vector low = teapot.positions[0], high = low;
  for (const Vector& p : teapot.positions) {
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  EXPECT_EQ(low[1], 0);
  EXPECT_EQ(high[1], 3.15);
  EXPECT_EQ(low[0], -3);
  EXPECT_NEAR(high[0], 3.43, 0.01);
  EXPECT_EQ(low[2], -high[2]);
}

TEST_F(Teapot, left_and_right_are_mirror_images) {
  std::set<Vector> positions;
  for (const Vector& p : teapot.positions) positions.insert(p);
  for (const auto& [x, y, z] : teapot.positions) EXPECT_TRUE(positions.contains({x, y, -z}));
}

// The tessellations differ, so their distance is that of chords from the curved surface.
TEST_F(Teapot, agrees_with_the_model_in_circulation) {
  const ObjFaces other = read_obj_faces(BOXWOOD_SHARED_DIR "/models/teapot.obj");
  if (other.faces.empty()) GTEST_SKIP() << "no models/teapot.obj in " << BOXWOOD_SHARED_DIR;
  EXPECT_LT(farthest_vertex(other, teapot), 0.008);
  EXPECT_LT(farthest_vertex(teapot, other), 0.008);
}

}  // namespace
}  // namespace tracer
