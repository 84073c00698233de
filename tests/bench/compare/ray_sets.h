// SPDX-License-Identifier: MIT
// Rays of the four kinds that renderers ask, made once, the same floats for every tracer.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "tests/bench/compare/scenes.h"
#include "tracer/bvh/trace/accel.h"

namespace bench {

enum class Query { closest_hit, occluded };

/// `name` is one letter: P camera, S shadow, D diffuse bounce, I incoherent.
struct RayKind {
  std::string_view name;
  std::string_view label;
  Query query;
};
inline constexpr RayKind ray_kinds[] = {
    {"P", "camera rays", Query::closest_hit},
    {"S", "shadow rays", Query::occluded},
    {"D", "diffuse bounces", Query::closest_hit},
    {"I", "random rays", Query::closest_hit},
};

struct RaySet {
  const RayKind* kind = nullptr;
  std::vector<tracer::Ray> rays;
};

/// Rays of a block are neighbours in the picture: 16x16 pixels, in Morton order within.
inline constexpr size_t rays_a_block = 256;

/// One of each kind. P: a picture of side_px^2, a multiple of 16, block by block. S: from each hit
/// of P to the light. D: from each hit of P, by the cosine. I: between two random points of the
/// bounding sphere, side_px^2 of them. Origins of S and D stand off their surface by far more than
/// a float's error there, so that no tracer needs a distance to skip.
std::vector<RaySet> make_ray_sets(const Scene& scene, const tracer::Accel& accel, int side_px);

/// Every `stride`th block.
RaySet thinned(const RaySet& set, size_t stride);

}  // namespace bench
