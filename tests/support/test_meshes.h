// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tests/support/random_source.h"
#include "tracer/geometry/mesh.h"

namespace tracer {

/// Sets the bounds from the triangles.
Mesh make_test_mesh(const std::vector<Vec3f>& positions, const std::vector<Vec3u>& triangles);
Mesh make_test_mesh(std::span<const Vec3f> positions, std::span<const Vec3u> triangles);

/// Triangles of side about `size` anywhere in [-1, 1]^3.
Mesh random_soup(uint32_t triangle_count, float size, uint32_t seed);

/// A closed surface around the origin: a subdivided cube pushed out to radius 1 +- roughness.
Mesh rough_ball(int cells_a_side, float roughness, uint32_t seed);

/// Axis-parallel squares of two triangles each, on the planes and corners of a small lattice, so
/// that they overlap and coincide.
Mesh lattice_quads(uint32_t quad_count, uint32_t seed);

/// The same mesh, every position moved by `offset`.
Mesh moved(Mesh mesh, const Vec3f& offset);

/// Each triangle `copies` times.
Mesh repeated(Mesh mesh, int copies);

/// v and triangular f lines only; no triangles where the file is missing.
Mesh read_plain_obj(const std::string& path);

}  // namespace tracer
