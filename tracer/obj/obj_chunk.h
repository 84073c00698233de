// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tracer/base/error.h"
#include "tracer/base/page_arena.h"
#include "tracer/base/vectors.h"
#include "tracer/geometry/world_bounds.h"

namespace tracer {

/// Polygons of more corners are dropped.
inline constexpr uint32_t max_face_corners = 1u << 20;

/// A name and the line, from 1, that first says it; 0 where none does.
struct ObjName {
  std::string text;
  int64_t line = 0;
  bool operator==(const ObjName&) const = default;
};

/// How many a text defines.
struct ObjCounts {
  uint64_t positions = 0;
  uint64_t texcoords = 0;
  uint64_t normals = 0;
};

/// Which indices each corner of a run has, in the order position, texcoord, normal.
enum class CornerForm : uint8_t { position = 0, texcoord = 1, normal = 2, both = 3 };

constexpr bool has_texcoord(CornerForm form) {
  return (static_cast<int>(form) & 1) != 0;
}
constexpr bool has_normal(CornerForm form) {
  return (static_cast<int>(form) & 2) != 0;
}
constexpr uint32_t indices_a_corner(CornerForm form) {
  return 1u + has_texcoord(form) + has_normal(form);
}

constexpr CornerForm without_texcoord(CornerForm form) {
  return has_normal(form) ? CornerForm::normal : CornerForm::position;
}

/// Whether anybody will look textures up.
enum class Texcoords { kept, dropped };

/// Faces on consecutive lines that have as many corners each, of one form. The counts are of what
/// the chunk has defined before them.
struct FaceRun {
  uint64_t first_index = 0;  // into ObjChunk::indices
  uint32_t face_count = 0;
  uint32_t corner_count = 0;  // of each face, 3 or more
  uint32_t material = 0;      // index into ObjChunk::material_names
  uint32_t line = 0;          // of the first face
  uint32_t position_count = 0;
  uint32_t texcoord_count = 0;
  uint32_t normal_count = 0;
  CornerForm form = CornerForm::position;

  uint64_t indices_a_face() const { return uint64_t{corner_count} * indices_a_corner(form); }
};

/// The largest index of each kind that faces name. Negative ones count as unsigned numbers do: as
/// more than any array holds.
struct LargestIndices {
  uint32_t position = 0;
  uint32_t texcoord = 0;
  uint32_t normal = 0;
};

/// Elements that are no polygons, which are passed over.
struct OtherElements {
  uint64_t points = 0;      // p
  uint64_t lines = 0;       // l
  uint64_t free_forms = 0;  // curv, curv2, surf
  int64_t first_free_form_line = 0;
};

/// What a run of whole statements says, known without what stands before it: lines and materials
/// count from its own start.
struct ObjChunk {
  PageArray<Vec3d> positions;
  PageArray<Vec3f> colors;  // empty, or one a position; NaN where the text has none
  PageArray<Vec2f> texcoords;
  uint64_t texcoord_count = 0;  // of those dropped too
  bool has_dropped_texcoords = false;
  PageArray<Vec3f> normals;
  // As written: from 1, negative ones from the last defined, 0 for none. Positions are never 0.
  PageArray<int32_t> indices;
  PageArray<FaceRun> runs;
  WorldBounds bounds;                  // of the positions that floats can hold
  bool has_unusable_position = false;  // not finite, or larger than any float
  LargestIndices largest;
  uint64_t face_count = 0;
  uint64_t corner_count = 0;
  uint64_t triangle_count = 0;          // of all faces
  std::vector<uint32_t> painted;        // ZBrush's #MRGB: 0xMMRRGGBB, of vertices in order
  std::vector<ObjName> material_names;  // [0] stands for the material in force before
  uint32_t last_material = 0;           // in force at the end
  std::vector<ObjName> material_libraries;
  OtherElements others;
  uint32_t object_count = 0;
  uint32_t group_count = 0;
  int64_t line_count = 0;
  int64_t dropped_faces = 0;
  Warnings warnings;  // without the path

  ObjCounts counts() const { return {positions.size(), texcoord_count, normals.size()}; }
};

/// Whether a float can hold the position.
inline bool fits_float(const Vec3d& position) {
  constexpr double largest = std::numeric_limits<float>::max();
  return std::abs(position.x) <= largest && std::abs(position.y) <= largest &&
         std::abs(position.z) <= largest;
}

}  // namespace tracer
