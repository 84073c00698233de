// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/base/error.h"
#include "tracer/base/vectors.h"
#include "tracer/obj/obj_file.h"

namespace tracer {

/// Polygons of more corners are dropped.
inline constexpr uint32_t max_face_corners = 1u << 20;

/// Indices as the file has them: from 1, negative ones from the last defined, 0 for none.
struct WrittenCorner {
  int32_t position = 0;
  int32_t texcoord = 0;
  int32_t normal = 0;
};

/// The counts are of what this chunk has defined before the face.
struct WrittenFace {
  uint32_t first_corner = 0;
  uint32_t corner_count = 0;
  uint32_t material = 0;
  uint32_t line = 0;
  uint32_t position_count = 0;
  uint32_t texcoord_count = 0;
  uint32_t normal_count = 0;
};

/// What a run of whole statements says, known without what stands before it: lines and materials
/// count from its own start.
struct ObjChunk {
  std::vector<Vec3d> positions;
  std::vector<Vec3f> colors;  // empty, or one a position; NaN where the text has none
  std::vector<Vec2f> texcoords;
  std::vector<Vec3f> normals;
  std::vector<WrittenCorner> corners;
  std::vector<WrittenFace> faces;
  std::vector<ObjName> material_names;  // [0] stands for the material in force before
  uint32_t last_material = 0;           // in force at the end
  std::vector<ObjName> material_libraries;
  uint32_t object_count = 0;
  uint32_t group_count = 0;
  uint32_t line_count = 0;
  int64_t dropped_faces = 0;
  Warnings warnings;  // without the path
};

ObjChunk parse_obj_chunk(std::string_view bytes);

}  // namespace tracer
