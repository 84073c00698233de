// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/base/byte_source.h"
#include "tracer/base/error.h"
#include "tracer/base/progress.h"
#include "tracer/obj/obj_chunk.h"

namespace tracer {

/// Models beyond these are refused: 32-bit indices count triangles and vertices.
struct ObjLimits {
  uint64_t corners = 0xffffffffu;
  uint64_t triangles = 0x7fffffffu;
  uint64_t vertices = 0x7fffffffu;  // and texture coordinates, and normals
};

/// A chunk whose place in the file is known. Its indices count from the file's begin, from 1, are
/// in range, and 0 where there is none; a face whose first one is 0 is dropped.
struct PlacedChunk {
  ObjChunk chunk;
  ObjCounts before;  // what stands in the file before it
  int64_t lines_before = 0;
  std::vector<uint32_t>
      materials;  // indices into ObjFile::material_names, by material of the chunk
};

/// What an OBJ file says, before triangulation and in the file's own order. Coordinates are the
/// correctly rounded doubles, other numbers the correctly rounded floats of the text; they may be
/// infinite or NaN where the text is.
struct ObjFile {
  std::vector<PlacedChunk> chunks;
  ObjCounts counts;
  uint64_t face_count = 0;              // those that are not dropped
  bool has_colors = false;              // of any vertex
  bool lacks_texcoords = false;         // dropped, and of use: it is to be parsed with them
  std::vector<ObjName> material_names;  // [0] is "" until the first usemtl
  std::vector<ObjName> material_libraries;
  uint32_t object_count = 0;  // o
  uint32_t group_count = 0;   // g
  OtherElements others;
  int64_t dropped_faces = 0;  // each has a warning
  Warnings warnings;
};

/// Parses a whole file. `path` is only for messages. What is wrong is dropped and said in
/// `warnings` as path:line. With Texcoords::dropped, texture coordinates are dropped unless the
/// file's begin names a material library; `lacks_texcoords` tells where that was wrong. Throws
/// LoadError where the source does or a limit is passed, and Cancelled.
ObjFile parse_obj(ByteSource& source, const std::string& path, Progress& progress,
                  Texcoords texcoords = Texcoords::kept, const ObjLimits& limits = {});
ObjFile parse_obj(std::string_view bytes, const std::string& path, Progress& progress,
                  Texcoords texcoords = Texcoords::kept);

}  // namespace tracer
