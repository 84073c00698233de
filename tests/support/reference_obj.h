// SPDX-License-Identifier: MIT
// What an OBJ file says, read word by word with strings and strtod: slow, and simple enough to be
// believed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/base/vectors.h"

namespace tracer {

/// Indices from 0; -1 where there is none.
struct ReferenceCorner {
  int64_t position = -1;
  int64_t texcoord = -1;
  int64_t normal = -1;
};

struct ReferenceFace {
  int64_t line = 0;  // from 1
  std::string material;
  std::vector<ReferenceCorner> corners;  // 3 or more, of positions that exist and floats can hold
};

struct ReferenceObj {
  std::vector<Vec3d> positions;  // NaN where the text is malformed
  std::vector<Vec2d> texcoords;
  std::vector<Vec3d> normals;
  std::vector<ReferenceFace> faces;
  std::vector<int64_t> lines_of_dropped_faces;
};

ReferenceObj read_reference_obj(std::string_view bytes);

}  // namespace tracer
