// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/geometry/world_bounds.h"
#include "tracer/obj/obj_file.h"

namespace tracer {

/// The bounds of the positions that faces use, empty where there are none. A face of which a
/// position is too large for a float, or not finite, uses none, and is marked as dropped: its first
/// index becomes 0. For each chunk's such faces `faults` gets a warning without the path.
WorldBounds find_used_bounds(ObjFile& file, std::vector<Warnings>& faults);

}  // namespace tracer
