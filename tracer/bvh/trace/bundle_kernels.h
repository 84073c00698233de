// SPDX-License-Identifier: MIT
// Several rays at once, with the bits that closest_hit_wide and occluded_wide give each alone.
#pragma once

#include <span>

#include "tracer/base/progress.h"
#include "tracer/bvh/layout/wide_tree.h"
#include "tracer/geometry/ray.h"

namespace tracer {

/// Rays of one bundle at most, and bundles that are traced together.
inline constexpr size_t bundle_size = 64;
inline constexpr size_t bundles_under_way = 8;

/// Bit i: of the i-th bundle.
struct BundleVerdicts {
  uint32_t answered = 0;
  uint32_t given_up = 0;  // met more leaves than leaves_a_ray allows
};

/// The closest hits of as many rays as bundles under way hold, or fewer; rays beyond the hits are
/// those that will be asked for next. Each bundle_size of them in a row make a bundle if they leave
/// one origin in similar directions. hits[i] belongs to rays[i]; those of bundles that are not
/// answered mean nothing. Once `stop` is requested answers may be misses.
BundleVerdicts closest_hits_bundles(const WideTree& tree, std::span<const Ray> rays,
                                    size_t leaves_a_ray, const StopFlag& stop, std::span<Hit> hits);

/// Which of as many rays meet anything: 1, or 0. Bundles end in one point (at a finite t_max),
/// coming from similar directions. Likewise.
BundleVerdicts occluded_bundles(const WideTree& tree, std::span<const Ray> rays,
                                size_t leaves_a_ray, const StopFlag& stop,
                                std::span<uint8_t> is_occluded);

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
