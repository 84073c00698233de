// SPDX-License-Identifier: MIT
#include "tests/bench/compare/kernel_blocks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/support/random_source.h"
#include "tests/support/test_meshes.h"
#include "tracer/base/directions.h"
#include "tracer/base/trigonometry.h"
#include "tracer/bvh/trace/wide_kernels.h"

namespace bench {
namespace {

using tracer::Mesh;
using tracer::RandomSource;
using tracer::Ray;
using tracer::Vec3d;
using tracer::Vec3f;
using tracer::Vec3u;

constexpr Aiming table[] = {
    {.name = "random", .what = "through random points of the block's box", .sine_low = 0.1f},
    {.name = "edges", .what = "at shared edges", .aim = Aim::edges},
    {.name = "vertices", .what = "at the vertex all triangles share", .aim = Aim::vertices},
    {.name = "grazing",
     .what = "at both, within a degree of the plane",
     .aim = Aim::edges_and_vertices,
     .roughness = 0.0005f,
     .sine_low = 0.004f,
     .sine_high = 0.017f},
    {.name = "far",
     .what = "at both, from 10,000 sizes away",
     .aim = Aim::edges_and_vertices,
     .distance = 1e4f},
    {.name = "offset",
     .what = "at both, 100,000 sizes from the coordinates' origin",
     .aim = Aim::edges_and_vertices,
     .offset = 1e5f},
    {.name = "away", .what = "away from the block: what a call costs in itself", .aim = Aim::away},
};

uint32_t block_width() {
  const int width = tracer::wide_kernel_width();
  return width > 0 ? static_cast<uint32_t>(width) : 8;
}

Vec3d random_direction(RandomSource& random) {
  return tracer::unit_or(Vec3d(random.vector(-1, 1)), Vec3d(0, 0, 1));
}

void add_fan(const Vec3d& hub, const Vec3d& normal, const Aiming& aiming, uint32_t fan_size,
             RandomSource& random, std::vector<Vec3f>& positions, std::vector<Vec3u>& triangles) {
  const auto first = static_cast<uint32_t>(positions.size());
  const tracer::Tangents tangents = tracer::tangents_of(normal);
  positions.emplace_back(hub);
  for (uint32_t i = 0; i < fan_size; ++i) {
    const tracer::CosSin angle = tracer::cos_sin_of_turns((i + 0.5 * random.unit()) / fan_size);
    positions.emplace_back(hub + angle.cos * tangents.x + angle.sin * tangents.y +
                           double{random.between(-1, 1) * aiming.roughness} * normal);
  }
  for (uint32_t i = 0; i < fan_size; ++i) {
    const uint32_t corners[] = {first, first + 1 + i, first + 1 + (i + 1) % fan_size};
    const auto start = static_cast<uint32_t>(random.integer(0, 2));
    triangles.emplace_back(corners[start], corners[(start + 1) % 3], corners[(start + 2) % 3]);
  }
}

Vec3f point_between(const Vec3f& a, const Vec3f& b, float part) {
  return {glm::mix(Vec3d(a), Vec3d(b), double{part})};
}

Vec3f pick_target(Aim aim, const KernelBlock& block, RandomSource& random) {
  const Mesh& mesh = *block.mesh;
  if (aim == Aim::anywhere || aim == Aim::away) {
    Vec3f target;
    for (int axis = 0; axis < 3; ++axis) {
      target[axis] = random.between(mesh.bounds.min[axis], mesh.bounds.max[axis]);
    }
    return target;
  }
  const uint32_t fan_count = block.triangle_count() / block.fan_size;
  const auto fan = static_cast<uint32_t>(random.integer(0, static_cast<int>(fan_count) - 1));
  const uint32_t hub = fan * (block.fan_size + 1);
  const bool takes_hub =
      aim == Aim::vertices || (aim == Aim::edges_and_vertices && random.integer(0, 1) == 0);
  if (takes_hub) return mesh.positions[hub];
  const auto spoke = static_cast<uint32_t>(random.integer(1, static_cast<int>(block.fan_size)));
  return point_between(mesh.positions[hub], mesh.positions[hub + spoke],
                       random.between(0.05f, 0.95f));
}

}  // namespace

std::span<const Aiming> aimings() {
  return table;
}

tracer::WideTree make_one_block_tree(const Mesh& mesh) {
  tracer::BvhTree tree;
  tree.nodes.push_back({mesh.bounds, 0, mesh.triangle_count()});
  tree.primitives.resize(mesh.triangle_count());
  std::iota(tree.primitives.begin(), tree.primitives.end(), 0u);
  tracer::Progress progress;
  return build_wide_tree(tree, mesh, static_cast<int>(block_width()), progress);
}

KernelBlock make_kernel_block(const Aiming& aiming, uint32_t seed) {
  RandomSource random(seed);
  KernelBlock block;
  block.normal = random_direction(random);
  block.fan_size = std::min(block_width(), 8u);
  const Vec3d across = tracer::tangents_of(block.normal).x;
  const Vec3d center = double{aiming.offset} * random_direction(random);
  std::vector<Vec3f> positions;
  std::vector<Vec3u> triangles;
  for (uint32_t fan = 0; triangles.size() < block_width(); ++fan) {
    add_fan(center + (2.0 * fan) * across, block.normal, aiming, block.fan_size, random, positions,
            triangles);
  }
  block.mesh = std::make_shared<const Mesh>(
      tracer::make_test_mesh(std::move(positions), std::move(triangles)));
  if (tracer::wide_kernel_width() > 0) block.tree = make_one_block_tree(*block.mesh);
  return block;
}

std::vector<Ray> make_aimed_rays(const Aiming& aiming, const KernelBlock& block, size_t count,
                                 uint32_t seed) {
  RandomSource random(seed);
  const tracer::Tangents tangents = tracer::tangents_of(block.normal);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const Vec3f target = pick_target(aiming.aim, block, random);
    const double sine = random.between(aiming.sine_low, aiming.sine_high);
    const tracer::CosSin angle = tracer::cos_sin_of_turns(random.unit());
    const Vec3d away = sine * block.normal + std::sqrt(1 - sine * sine) *
                                                 (angle.cos * tangents.x + angle.sin * tangents.y);
    const Vec3f origin(Vec3d(target) + double{aiming.distance} * away);
    // At unit length, so that few rays meet their target without any error.
    const double toward = aiming.aim == Aim::away ? -1 : 1;
    const Vec3f direction(toward * glm::normalize(Vec3d(target) - Vec3d(origin)));
    rays.push_back({.origin = origin, .direction = direction});
  }
  return rays;
}

}  // namespace bench
