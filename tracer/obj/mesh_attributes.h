// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tracer/geometry/mesh.h"
#include "tracer/geometry/world_bounds.h"
#include "tracer/obj/obj_file.h"

namespace tracer {

/// The triangles of a run of faces.
struct TriangleBlock {
  std::vector<Vec3u> corners;       // indices into ObjFile::corners
  std::vector<uint32_t> materials;  // one a triangle
  WorldBounds bounds;
  int64_t dropped_faces = 0;
  Warnings warnings;
};

/// Fills the triangles of all blocks, in order, and what the file says of their corners. Arrays
/// that no triangle uses stay empty; normals without a direction count as none.
void fill_triangles(const ObjFile& file, const std::vector<TriangleBlock>& blocks, Mesh& mesh);

}  // namespace tracer
