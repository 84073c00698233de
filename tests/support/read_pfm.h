// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "tracer/base/vectors.h"

namespace tests {

/// A colour PFM; size 0x0 where it is none.
struct Pfm {
  tracer::Vec2i size_px{0, 0};
  std::vector<tracer::Vec3f> pixels;  // row 0 on top
  const tracer::Vec3f& at(int x, int y) const {
    return pixels.at(static_cast<size_t>(y) * size_px.x + x);
  }
};

Pfm read_pfm(const std::filesystem::path& path);

}  // namespace tests
