// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "assets/polygonise.h"

namespace assets {

struct PaintedSurface {
  std::vector<Vec3d> points;
  std::vector<std::array<uint32_t, 3>> triangles;  // counterclockwise from outside
  std::vector<uint8_t> materials;                  // one a triangle: 0, or 1 + the region's index
};

/// Cuts triangles along the zero sets of `regions`, so that each triangle lies in one of them or in
/// none. Later regions lie over earlier ones. A closed manifold stays one.
PaintedSurface paint(Surface surface, std::span<const Field> regions);

}  // namespace assets
