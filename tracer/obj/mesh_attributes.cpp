// SPDX-License-Identifier: MIT
#include "tracer/obj/mesh_attributes.h"

#include <atomic>

#include "tracer/base/parallel.h"

namespace tracer {
namespace {

constexpr size_t elements_a_task = 16384;

/// Which optional arrays any triangle uses.
struct Usage {
  std::atomic<bool> normals{false};
  std::atomic<bool> texcoords{false};
  std::atomic<bool> materials{false};
};

/// Zero where the vector has no direction.
Vec3f unit_or_zero(const Vec3f& vector) {
  if (!is_finite(vector)) return Vec3f(0.0f);
  const Vec3d wide(vector);
  const double length = std::sqrt(glm::dot(wide, wide));
  return length > 0 ? Vec3f(wide / length) : Vec3f(0.0f);
}

std::vector<Vec3f> unit_normals(const ObjFile& file) {
  std::vector<Vec3f> normals(file.normals.size());
  parallel_for_ranges(0, normals.size(), elements_a_task, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) normals[i] = unit_or_zero(file.normals[i]);
  });
  return normals;
}

/// Files write colours from 0 to 1 or from 0 to 255; a vertex without one is white.
std::vector<Vec3f> scaled_colors(const ObjFile& file) {
  float largest = 0;
  for (const Vec3f& color : file.colors) {
    if (is_finite(color)) largest = std::max({largest, color.x, color.y, color.z});
  }
  const float unit = largest > 1 ? 255.0f : 1.0f;
  std::vector<Vec3f> colors(file.colors.size(), Vec3f(1.0f));
  for (size_t i = 0; i < colors.size(); ++i) {
    if (is_finite(file.colors[i])) colors[i] = glm::clamp(file.colors[i] / unit, 0.0f, 1.0f);
  }
  return colors;
}

/// The member of each of a triangle's corners.
Vec3u gather(const ObjFile& file, const Vec3u& corners, uint32_t ObjCorner::*member) {
  return {file.corners[corners.x].*member, file.corners[corners.y].*member,
          file.corners[corners.z].*member};
}

void drop_zero_normals(const std::vector<Vec3f>& normals, Vec3u& indices) {
  for (int i = 0; i < 3; ++i) {
    if (indices[i] != no_index && normals[indices[i]] == Vec3f(0.0f)) indices[i] = no_index;
  }
}

void fill_block(const ObjFile& file, const TriangleBlock& block, size_t first, Usage& usage,
                Mesh& mesh) {
  constexpr Vec3u none(no_index);
  for (size_t i = 0; i < block.corners.size(); ++i) {
    const Vec3u& corners = block.corners[i];
    mesh.triangles[first + i] = gather(file, corners, &ObjCorner::position);
    if (!mesh.normal_indices.empty()) {
      Vec3u& normals = mesh.normal_indices[first + i];
      normals = gather(file, corners, &ObjCorner::normal);
      drop_zero_normals(mesh.normals, normals);
      if (normals != none) usage.normals = true;
    }
    if (!mesh.texcoord_indices.empty()) {
      Vec3u& texcoords = mesh.texcoord_indices[first + i];
      texcoords = gather(file, corners, &ObjCorner::texcoord);
      if (texcoords != none) usage.texcoords = true;
    }
    if (!mesh.materials.empty()) {
      mesh.materials[first + i] = block.materials[i];
      if (block.materials[i] != 0) usage.materials = true;
    }
  }
}

}  // namespace

void fill_triangles(const ObjFile& file, const std::vector<TriangleBlock>& blocks, Mesh& mesh) {
  static_assert(no_obj_index == no_index);
  std::vector<size_t> firsts;
  size_t triangle_count = 0;
  for (const TriangleBlock& block : blocks) {
    firsts.push_back(triangle_count);
    triangle_count += block.corners.size();
  }
  mesh.triangles.resize(triangle_count);
  mesh.normal_indices.resize(file.normals.empty() ? 0 : triangle_count);
  mesh.texcoord_indices.resize(file.texcoords.empty() ? 0 : triangle_count);
  mesh.materials.resize(file.material_names.size() > 1 ? triangle_count : 0);
  mesh.normals = unit_normals(file);
  mesh.texcoords = file.texcoords;
  mesh.colors = scaled_colors(file);
  Usage usage;
  parallel_for_each_index(0, blocks.size(), [&](size_t block) {
    fill_block(file, blocks[block], firsts[block], usage, mesh);
  });
  if (!usage.normals) mesh.normals = {}, mesh.normal_indices = {};
  if (!usage.texcoords) mesh.texcoords = {}, mesh.texcoord_indices = {};
  if (!usage.materials) mesh.materials = {};
}

}  // namespace tracer
