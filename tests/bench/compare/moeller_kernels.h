// SPDX-License-Identifier: MIT
// The production traversal with leaves that are not exact: the price of exactness is the
// difference.
#pragma once

#include <cstdint>
#include <span>

#include "tracer/base/progress.h"
#include "tracer/bvh/layout/wide_tree.h"
#include "tracer/geometry/ray.h"

namespace bench {

// As the functions of wide_kernels.h and bundle_kernels.h of like names, with Moeller and
// Trumbore's test in float [Moeller 1997] for the verdict and t.

[[nodiscard]] bool closest_hit_moeller(const tracer::WideTree& tree, const tracer::Ray& ray,
                                       const tracer::StopFlag& stop, tracer::Hit& hit);
[[nodiscard]] bool occluded_moeller(const tracer::WideTree& tree, const tracer::Ray& ray,
                                    const tracer::StopFlag& stop, tracer::Hit& hit);
size_t closest_hits_stream_moeller(const tracer::WideTree& tree, std::span<const tracer::Ray> rays,
                                   const tracer::StopFlag& stop, std::span<tracer::Hit> hits);
size_t occluded_stream_moeller(const tracer::WideTree& tree, std::span<const tracer::Ray> rays,
                               const tracer::StopFlag& stop, std::span<uint8_t> is_occluded);

}  // namespace bench
