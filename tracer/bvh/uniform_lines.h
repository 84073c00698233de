// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "tracer/geometry/box.h"
#include "tracer/geometry/ray.h"

namespace tracer {

/// The `index`th of a fixed sequence of lines, uniform among all that meet `box`: those of which
/// the surface area heuristic speaks. It enters the box at its origin. `box` has an area.
Ray uniform_line(const Box& box, uint32_t index);

}  // namespace tracer
