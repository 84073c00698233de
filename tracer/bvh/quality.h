// SPDX-License-Identifier: MIT
// What tells a good tree from a bad one where the surface area heuristic errs.
#pragma once

#include <cstdint>

#include "tracer/base/progress.h"
#include "tracer/bvh/metrics.h"
#include "tracer/bvh/tree.h"
#include "tracer/geometry/mesh.h"

namespace tracer {

/// Effective primitive overlap [Aila 2013]: a point of the surface lies in its own nodes, and in
/// others that overlap them. The SahCosts of those others, averaged over the surface: what a ray
/// that ends there pays in vain. 0 where no node reaches into another's surface.
struct Epo {
  double value = 0;
  uint32_t sample_count = 0;  // drawn by area from the triangles; 0: the value is of all of them
};

/// Leaf count variability [Aila 2013]: the standard deviation of the number of leaves that lines,
/// uniform through the root's box, meet. Where it is high, rays traced side by side wait for one
/// another.
struct Lcv {
  double value = 0;
  uint32_t ray_count = 0;  // that were tried
};

struct TreeQuality {
  Epo epo;
  Lcv lcv;
};

// All three: `tree` is over the triangles of `mesh`, which may be in several leaves; the result has
// the same bits at any number of threads; throw Cancelled.
Epo measure_epo(const BvhTree& tree, const Mesh& mesh, const SahCosts& costs,
                const Progress& progress);
Lcv measure_lcv(const BvhTree& tree, const Progress& progress);
TreeQuality measure_quality(const BvhTree& tree, const Mesh& mesh, const SahCosts& costs,
                            const Progress& progress);

}  // namespace tracer
