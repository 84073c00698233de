// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "tracer/geometry/box4.h"

namespace tracer {

/// Cuts a triangle by planes across `axis`, in ascending order: parts[i] becomes the box of what
/// lies between planes[i - 1] and planes[i], of all below planes[0] and of all above the last one
/// at the ends; empty where there is nothing. parts.size() is planes.size() + 1. Each box
/// contains the exact part, and no point of it is farther from that part than 2^-19 of the largest
/// coordinates of the triangle (docs/numerics.md); corners and planes are taken as they are.
void slice_triangle(const std::array<Vec3f, 3>& corners, int axis, std::span<const float> planes,
                    std::span<Box4> parts);

}  // namespace tracer
