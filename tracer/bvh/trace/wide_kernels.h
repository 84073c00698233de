// SPDX-License-Identifier: MIT
#pragma once

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

/// The closest hit, and whether there is any: the same bits as the recursive reference gives over
/// the same triangles. `tree.width` equals wide_kernel_width().
/// Once `stop` is requested the answer may be a miss.
Hit closest_hit_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop);
bool occluded_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop);

}  // namespace tracer
