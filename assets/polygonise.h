// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "tracer/base/vectors.h"

namespace assets {

using tracer::Vec3d;
using Field = std::function<double(const Vec3d&)>;  // negative inside

struct Surface {
  std::vector<Vec3d> points;
  std::vector<std::array<uint32_t, 3>> triangles;  // counterclockwise from outside
};

/// The zero set of `field` by marching tetrahedra, six to each cube of side `step`: closed and
/// manifold wherever the field is positive on the border of the box. [Doi 1991]
Surface polygonise(const Field& field, const Vec3d& lower, const Vec3d& upper, double step);

/// Moves each point towards the mean of its neighbours and back onto the zero set of `field`, which
/// evens out the triangles.
void relax(Surface& surface, const Field& field);

/// The gradient by central differences, as long as the field is steep.
Vec3d gradient(const Field& field, const Vec3d& point);

/// The nearest point of the zero set, by Newton steps along the gradient.
Vec3d project(const Field& field, Vec3d point);

}  // namespace assets
