// SPDX-License-Identifier: MIT
// What rays are aimed at, and the float formulas that serve as failing controls.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/support/random_source.h"
#include "tracer/geometry/box.h"
#include "tracer/geometry/mesh.h"
#include "tracer/geometry/ray.h"

namespace tracer::stress {

struct TestTriangle {
  Vec3f v0, v1, v2;

  Box bounds() const;
};

std::string literal(const TestTriangle& triangle);

/// What many renderers have, in float: leaks at edges and vertices.
bool moeller_trumbore(const Ray& ray, const TestTriangle& triangle);
/// Sides of the edges as Pluecker lines, in float, with a tolerance relative to their sum: hits
/// what lies beside a thin triangle. The distance, where there is one and it is not negative.
std::optional<float> pluecker(const Ray& ray, const TestTriangle& triangle);
/// (plane - origin) * (1 / direction), in float and without padding: loses hits.
bool naive_slabs(const Ray& ray, const Box& box);

/// Three perpendicular directions, turned at random.
struct RandomAxes {
  explicit RandomAxes(RandomSource& random);
  Vec3d along(const Vec3d& local) const { return local.x * x + local.y * y + local.z * z; }

  Vec3d x, y, z;
};

TestTriangle triangle_of(const Mesh& mesh, uint32_t triangle);
uint32_t random_triangle(const Mesh& mesh, RandomSource& random);
/// A vertex, a point of an edge, or one of the inside, as nearly as floats can.
Vec3f random_target(const Mesh& mesh, uint32_t triangle, RandomSource& random);

/// A closed surface around the origin whose vertices are multiples of 16 within +-4096 * radius:
/// rays can be aimed at its vertices and edges exactly.
Mesh lattice_ball(int cells_a_side, uint32_t seed);

/// Rays in groups of 64, one kind each: from one point in similar directions, towards one point,
/// along axes, from and to anywhere; at vertices, edges and insides, from near and far.
std::vector<Ray> probing_rays(const Mesh& mesh, uint64_t group, RandomSource& random);
inline constexpr size_t rays_a_group = 64;

}  // namespace tracer::stress
