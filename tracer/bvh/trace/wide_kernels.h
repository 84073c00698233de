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

/// What the kernels did for some rays.
struct VisitCounts {
  uint64_t nodes = 0;        // each one test of all its children's boxes
  uint64_t blocks = 0;       // each one filter of all its triangles
  uint64_t triangles = 0;    // in those blocks
  uint64_t exact_tests = 0;  // that the filter could not exclude
};

/// The closest hit: the same bits as the recursive reference gives over the same triangles. False
/// where the ray is out of range and wide_scalar.h must answer: the direction's largest component
/// or the scene's and the origin's largest coordinate together not between 2^-36 and 2^36.
/// `tree.width` equals wide_kernel_width(). Once `stop` is requested the answer may be a miss.
[[nodiscard]] bool closest_hit_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop,
                                    Hit& hit);
/// As above; `hit` is any hit, and only whether it is one counts.
[[nodiscard]] bool occluded_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop,
                                 Hit& hit);

/// The same kernels, compiled to count as well.
[[nodiscard]] bool closest_hit_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop,
                                    Hit& hit, VisitCounts& counts);
[[nodiscard]] bool occluded_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop,
                                 Hit& hit, VisitCounts& counts);

}  // namespace tracer
