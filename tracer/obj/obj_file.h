// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/base/error.h"
#include "tracer/base/progress.h"
#include "tracer/base/vectors.h"

namespace tracer {

inline constexpr uint32_t no_obj_index = 0xffffffffu;

/// One corner of a face, as indices from 0 into the arrays of ObjFile; no_obj_index where the file
/// names none. `position` is always in range.
struct ObjCorner {
  uint32_t position = no_obj_index;
  uint32_t texcoord = no_obj_index;
  uint32_t normal = no_obj_index;
};

/// A name and the line, from 1, that first says it; 0 where none does.
struct ObjName {
  std::string text;
  uint32_t line = 0;
  bool operator==(const ObjName&) const = default;
};

/// A polygon of corner_count >= 3 corners from corners[first_corner].
struct ObjFace {
  uint32_t first_corner = 0;
  uint32_t corner_count = 0;
  uint32_t material = 0;  // index into material_names
  uint32_t line = 0;      // where the face stands in the file, from 1
};

/// What an OBJ file says, before triangulation and in the file's own order. Coordinates are the
/// correctly rounded doubles of the text; they may be infinite or NaN where the text is.
struct ObjFile {
  std::vector<Vec3d> positions;
  std::vector<Vec3f> colors;  // empty, or one a position: RGB as written, NaN where there is none
  std::vector<Vec2f> texcoords;
  std::vector<Vec3f> normals;
  std::vector<ObjCorner> corners;
  std::vector<ObjFace> faces;
  std::vector<ObjName> material_names;  // [0] is "" until the first usemtl
  std::vector<ObjName> material_libraries;
  uint32_t object_count = 0;  // o
  uint32_t group_count = 0;   // g
  int64_t dropped_faces = 0;  // each has a warning
  Warnings warnings;
};

/// Parses a whole file. `path` is only for messages. Never fails: what is wrong is dropped and
/// said in `warnings` as path:line. Throws Cancelled.
ObjFile parse_obj(std::string_view bytes, const std::string& path, Progress& progress);

}  // namespace tracer
