// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "tracer/base/large_vector.h"
#include "tracer/base/vectors.h"
#include "tracer/geometry/box.h"

namespace tracer {

inline constexpr uint32_t no_index = 0xffffffffu;

/// Indexed triangles. A position's place in the world is `origin + position`: the origin is
/// subtracted in double before the one rounding to float, so a scan in survey coordinates keeps
/// its detail. Every index is in range and every position that a triangle uses is finite.
struct Mesh {
  LargeVector<Vec3f> positions;
  LargeVector<Vec3u> triangles;         // indices into positions
  LargeVector<Vec3f> normals;           // unit length; may be empty
  LargeVector<Vec3u> normal_indices;    // empty, or one a triangle; no_index where there is none
  LargeVector<Vec2f> texcoords;         // may be empty
  LargeVector<Vec3u> texcoord_indices;  // empty, or one a triangle; no_index where there is none
  LargeVector<Vec3f> colors;            // empty, or linear RGB, one a position
  LargeVector<uint32_t> materials;      // empty (all 0), or one a triangle: index of its material
  Vec3d origin{};
  Box bounds;  // of all triangles, relative to origin

  uint32_t triangle_count() const { return static_cast<uint32_t>(triangles.size()); }
  uint32_t material_of(uint32_t triangle) const {
    return materials.empty() ? 0 : materials[triangle];
  }
  Box triangle_bounds(uint32_t triangle) const;
};

/// Boxes of all triangles, in order: all that a builder needs to know.
LargeVector<Box> primitive_boxes(const Mesh& mesh);

}  // namespace tracer
