// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "tracer/base/progress.h"
#include "tracer/bvh/layout/wide_tree.h"
#include "tracer/geometry/ray.h"

namespace tracer {

/// Lanes of the widest instructions that this processor has and there are kernels for: 16, 8 or 4;
/// 0 where there is no kernel for it and the recursive reference must answer.
int wide_kernel_width();

/// Whether no product of the filter over or underflows: the scene's largest coordinate and the
/// direction's largest component between 2^-36 and 2^36, the origin below 2^36. Other rays and
/// scenes are the recursive reference's.
bool is_in_kernel_range(const WideTree& tree, const Ray& ray);

/// What the kernels did for some rays.
struct VisitCounts {
  uint64_t nodes = 0;        // each one test of all its children's boxes
  uint64_t blocks = 0;       // each one filter of all its triangles
  uint64_t triangles = 0;    // in those blocks
  uint64_t exact_tests = 0;  // that the filter could not exclude
};

/// The closest hit, and whether there is any: the same bits as the recursive reference gives over
/// the same triangles. `tree.width` equals wide_kernel_width().
/// Once `stop` is requested the answer may be a miss.
Hit closest_hit_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop);
bool occluded_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop);

/// The same kernels, compiled to count as well.
Hit closest_hit_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop,
                     VisitCounts& counts);
bool occluded_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop, VisitCounts& counts);

}  // namespace tracer
