// SPDX-License-Identifier: MIT
// What ray-triangle kernels are tried on: blocks of triangles that meet in closed fans, and rays
// aimed where rounding decides.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "tracer/bvh/layout/wide_tree.h"
#include "tracer/geometry/mesh.h"
#include "tracer/geometry/ray.h"

namespace bench {

/// Where rays are aimed.
enum class Aim { anywhere, edges, vertices, edges_and_vertices, away };

/// A kind of rays, and of the fans they are aimed at. Lengths count in radii of a fan, 1.
struct Aiming {
  std::string_view name;
  std::string_view what;
  Aim aim = Aim::anywhere;
  float roughness = 0.05f;               // heights of the fan's rim above its plane
  float sine_low = 0.5f, sine_high = 1;  // of the angle between ray and plane
  float distance = 3;                    // of the ray's origin
  float offset = 0;                      // of the whole from the coordinates' origin

  /// Whether a ray that meets the fan must meet it however it is rounded: none grazes the rim.
  bool finds_leaks() const { return aim != Aim::anywhere && aim != Aim::away; }
};

/// Rays away from the block come last.
std::span<const Aiming> aimings();

/// As many triangles as the kernels take at once (eight where there are no kernels), in closed fans
/// of eight at most: triangle i is the mesh's and lane i of the tree's only block.
struct KernelBlock {
  std::shared_ptr<const tracer::Mesh> mesh;
  tracer::WideTree tree;
  tracer::Vec3d normal;   // of the fans' common plane
  uint32_t fan_size = 0;  // a fan's positions lie side by side, the hub before its rim

  uint32_t triangle_count() const { return mesh->triangle_count(); }
  const tracer::Vec3f& corner(uint32_t triangle, int corner) const {
    return mesh->positions[mesh->triangles[triangle][corner]];
  }
};

/// The same for the same seed.
KernelBlock make_kernel_block(const Aiming& aiming, uint32_t seed);
std::vector<tracer::Ray> make_aimed_rays(const Aiming& aiming, const KernelBlock& block,
                                         size_t count, uint32_t seed);

/// The tree over all triangles of a mesh, which fit into one block, in their order.
tracer::WideTree make_one_block_tree(const tracer::Mesh& mesh);

}  // namespace bench
