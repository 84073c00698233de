// SPDX-License-Identifier: MIT
// An ObjFile as plain arrays, for tests that ask what a text says.
#pragma once

#include <limits>
#include <vector>

#include "tracer/obj/obj_file.h"

namespace tracer {

inline constexpr uint32_t no_obj_index = 0xffffffffu;

struct FlatCorner {
  uint32_t position = no_obj_index;
  uint32_t texcoord = no_obj_index;
  uint32_t normal = no_obj_index;
};

struct FlatFace {
  std::vector<FlatCorner> corners;
  uint32_t material = 0;
  int64_t line = 0;
};

/// Indices count from 0; faces that are dropped are not there.
struct FlatObj : ObjFile {
  explicit FlatObj(ObjFile&& file) : ObjFile(std::move(file)) {
    for (const PlacedChunk& placed : chunks) add(placed);
  }

  std::vector<Vec3d> positions;
  std::vector<Vec3f> colors;  // empty, or one a position: NaN where the text has none
  std::vector<Vec2f> texcoords;
  std::vector<Vec3f> normals;
  std::vector<FlatFace> faces;

 private:
  void add(const PlacedChunk& placed) {
    const ObjChunk& chunk = placed.chunk;
    positions.insert(positions.end(), chunk.positions.begin(), chunk.positions.end());
    texcoords.insert(texcoords.end(), chunk.texcoords.begin(), chunk.texcoords.end());
    normals.insert(normals.end(), chunk.normals.begin(), chunk.normals.end());
    if (has_colors) {
      colors.insert(colors.end(), chunk.colors.begin(), chunk.colors.end());
      colors.resize(positions.size(), Vec3f(std::numeric_limits<float>::quiet_NaN()));
    }
    for (const FaceRun& run : chunk.runs) add_run(placed, run);
  }

  void add_run(const PlacedChunk& placed, const FaceRun& run) {
    const int32_t* index = placed.chunk.indices.data() + run.first_index;
    for (uint32_t i = 0; i < run.face_count; ++i) {
      const bool is_dropped = *index == 0;
      FlatFace face{{}, placed.materials[run.material], placed.lines_before + run.line + i};
      for (uint32_t k = 0; k < run.corner_count; ++k) {
        FlatCorner corner;
        corner.position = static_cast<uint32_t>(*index++) - 1;
        if (has_texcoord(run.form)) corner.texcoord = static_cast<uint32_t>(*index++) - 1;
        if (has_normal(run.form)) corner.normal = static_cast<uint32_t>(*index++) - 1;
        face.corners.push_back(corner);
      }
      if (!is_dropped) faces.push_back(std::move(face));
    }
  }
};

}  // namespace tracer
