// SPDX-License-Identifier: MIT
// Scenes of any size, the same on every machine, for measuring rather than for looking at.
#pragma once

#include "tracer/geometry/mesh.h"

namespace tracer {

/// A closed sphere around the origin, radius 1 +- 0.1 in smooth waves: 12 * cells_a_side^2
/// triangles, a cube's faces pushed out.
Mesh bumpy_sphere(int cells_a_side);

/// Long thin triangles, turned at random, anywhere in [-1, 1]^3: boxes of little use.
Mesh hair(uint32_t triangle_count, uint32_t seed);

/// A dense ball of size 1 (12 * ball_cells^2 triangles) on a floor of 10,000 in a coarse bowl:
/// detail at two scales, the teapot in a stadium.
Mesh stadium(int ball_cells);

/// Heights over [-1, 1]^2, y up: 2 * cells_a_side^2 triangles, hills upon hills.
Mesh terrain(int cells_a_side, uint32_t seed);

}  // namespace tracer
