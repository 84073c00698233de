// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>

#include "tracer/base/directions.h"
#include "tracer/base/parallel.h"
#include "tracer/base/trigonometry.h"
#include "tracer/scene/scene.h"

namespace tracer {
namespace {

bool has_normals_everywhere(const Mesh& mesh) {
  if (mesh.normal_indices.empty()) return false;
  const size_t count = mesh.normal_indices.size();
  return !parallel_any_of_ranges(0, count, 1 << 16, [&](size_t begin, size_t end) {
    uint32_t largest = 0;  // no_index is
    for (size_t i = begin; i < end; ++i) {
      const Vec3u& indices = mesh.normal_indices[i];
      largest = std::max({largest, indices.x, indices.y, indices.z});
    }
    return largest == no_index;
  });
}

/// Corners (3 * triangle + corner) in order of their position: those of position p are
/// corners[first[p], first[p + 1]), ascending.
struct CornersOfPositions {
  std::vector<uint32_t> first;
  std::vector<uint32_t> corners;
};

CornersOfPositions corners_of_positions(const Mesh& mesh) {
  CornersOfPositions result;
  result.first.resize(mesh.positions.size() + 1);
  result.corners.resize(3 * mesh.triangles.size());
  for (const Vec3u& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) ++result.first[triangle[corner]];
  }
  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  // first[p] is the end of p's corners, and falls to their beginning as they are filled in.
  for (size_t i = result.corners.size(); i-- > 0;) {
    const uint32_t position = mesh.triangles[i / 3][static_cast<int>(i % 3)];
    result.corners[--result.first[position]] = static_cast<uint32_t>(i);
  }
  return result;
}

/// The triangle's unit normal times its angle at the corner; zero without area.
Vec3d weighted_normal(const Mesh& mesh, uint32_t corner) {
  const Triangle triangle = triangle_at(mesh, corner / 3);
  const Vec3d vertices[3] = {triangle.v0, triangle.v1, triangle.v2};
  const int k = static_cast<int>(corner % 3);
  const Vec3d side = vertices[(k + 1) % 3] - vertices[k];
  const Vec3d other_side = vertices[(k + 2) % 3] - vertices[k];
  const Vec3d cross = glm::cross(side, other_side);
  const double angle = angle_of(glm::dot(side, other_side), glm::length(cross));
  return angle * unit_or(cross, Vec3d(0));
}

/// One normal a position, the angle-weighted mean over its triangles; zero where they cancel out.
LargeVector<Vec3f> vertex_normals(const Mesh& mesh) {
  const CornersOfPositions around = corners_of_positions(mesh);
  LargeVector<Vec3f> normals(mesh.positions.size());
  parallel_for_ranges(0, normals.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      Vec3d sum(0);
      for (uint32_t k = around.first[i]; k < around.first[i + 1]; ++k) {
        sum += weighted_normal(mesh, around.corners[k]);
      }
      normals[i] = Vec3f(unit_or(sum, Vec3d(0)));
    }
  });
  return normals;
}

/// The file's normals where it has them, followed by one a position for all other corners.
void complete_normals(Scene& scene) {
  const Mesh& mesh = *scene.mesh;
  const auto first_computed = static_cast<uint32_t>(mesh.normals.size());
  LargeVector<Vec3f> normals = mesh.normals;
  const LargeVector<Vec3f> computed = vertex_normals(mesh);
  normals.insert(normals.end(), computed.begin(), computed.end());

  LargeVector<Vec3u> indices = mesh.normal_indices;
  indices.resize(mesh.triangles.size(), Vec3u(no_index));
  for (size_t i = 0; i < indices.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      uint32_t& index = indices[i][corner];
      if (index == no_index) index = first_computed + mesh.triangles[i][corner];
    }
  }
  scene.shading_normals = std::make_shared<LargeVector<Vec3f>>(std::move(normals));
  scene.shading_normal_indices = std::make_shared<LargeVector<Vec3u>>(std::move(indices));
}

}  // namespace

Scene with_shading(const Scene& scene, Shading shading) {
  Scene result = scene;
  result.shading = shading;
  result.shading_normals.reset();
  result.shading_normal_indices.reset();
  if (shading == Shading::flat) return result;
  if (has_normals_everywhere(*scene.mesh)) {
    // Shared with the mesh, not copied.
    result.shading_normals = {scene.mesh, &scene.mesh->normals};
    result.shading_normal_indices = {scene.mesh, &scene.mesh->normal_indices};
  } else {
    complete_normals(result);
  }
  return result;
}

}  // namespace tracer
