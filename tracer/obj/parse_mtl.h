// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tracer/base/error.h"
#include "tracer/base/vectors.h"

namespace tracer {

/// One newmtl block, with the format's own names. Colours are linear RGB.
struct MtlMaterial {
  std::string name;
  Vec3f kd{0.8f};
  Vec3f ks{0.0f};
  Vec3f ke{0.0f};
  float ns = 0;
  float ni = 1;
  float d = 1;  // 1 - Tr
  int illum = 1;
  std::string map_kd;        // path as written, options removed; empty for none
  uint32_t map_kd_line = 0;  // from 1
};

struct MtlFile {
  std::vector<MtlMaterial> materials;
  Warnings warnings;
};

/// Parses a material library. `path` is only for messages. Never fails; unknown keywords are
/// passed over, malformed values are warnings.
MtlFile parse_mtl(std::string_view bytes, const std::string& path);

}  // namespace tracer
