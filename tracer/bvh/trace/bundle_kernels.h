// SPDX-License-Identifier: MIT
// Several rays at once, with the bits that closest_hit_wide and occluded_wide give each alone.
#pragma once

#include <span>

#include "tracer/base/progress.h"
#include "tracer/bvh/layout/wide_tree.h"
#include "tracer/geometry/ray.h"

namespace tracer {

/// Rays of one bundle at most.
inline constexpr size_t bundle_size = 64;

/// The closest hits of 1 to bundle_size rays that leave one origin in similar directions. False
/// where they do not, or are out of the filter's range: then `hits` is as it was. hits[i] belongs
/// to rays[i]. Once `stop` is requested answers may be misses.
[[nodiscard]] bool closest_hits_bundle(const WideTree& tree, std::span<const Ray> rays,
                                       const StopFlag& stop, std::span<Hit> hits);

/// Which of 1 to bundle_size rays that end in one point (at a finite t_max), coming from similar
/// directions, meet anything: 1, or 0. False as above.
[[nodiscard]] bool occluded_bundle(const WideTree& tree, std::span<const Ray> rays,
                                   const StopFlag& stop, std::span<uint8_t> is_occluded);

/// The closest hits of any rays, many under way at a time so that one works while others wait for
/// memory or for what they decide. [Barringer 2014] Returns how many it answered: rays up to the
/// first that is out of the filter's range, or up to where it was when `stop` was requested: then
/// some before that may be missing.
size_t closest_hits_stream(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                           std::span<Hit> hits);

/// Which of any rays meet anything: 1, or 0. Likewise.
size_t occluded_stream(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                       std::span<uint8_t> is_occluded);

}  // namespace tracer
