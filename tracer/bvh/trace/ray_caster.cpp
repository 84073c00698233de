// SPDX-License-Identifier: MIT
// Many rays at once: which kernel suits which of them.
#include <algorithm>
#include <cassert>

#include "tracer/bvh/trace/accel.h"
#include "tracer/bvh/trace/bundle_kernels.h"

namespace tracer {
namespace {

// Fewer rays are done sooner one by one.
constexpr size_t least_bundle = 8;
// In a row, after which every 32nd bundle is tried.
constexpr size_t most_failures = 5;

// Smaller trees are in the caches that cores share: nothing to wait for. Measured.
constexpr size_t least_tree_to_wait_for_bytes = size_t{16} << 20;
// Rays that meet hundreds of nodes are busy enough alone. Measured.
constexpr float most_steps_to_wait_for = 100;

size_t bundle_end(size_t first, size_t ray_count) {
  return std::min(first + bundle_size, ray_count);
}

bool may_share_origin(std::span<const Ray> rays) {
  return rays.size() >= least_bundle && rays.front().origin == rays.back().origin;
}

// Whether neighbours in the span start so far apart that each waits for memory of its own.
bool are_scattered(std::span<const Ray> rays, float max_coordinate) {
  constexpr size_t probe_count = 16;
  if (rays.size() < 2 * probe_count) return false;
  size_t far_apart = 0;
  for (size_t i = 1; i <= probe_count; ++i) {
    const Vec3d step = Vec3d(rays[i].origin) - Vec3d(rays[i - 1].origin);
    if (max_abs(step) > 0x1p-4 * double{max_coordinate}) ++far_apart;
  }
  return far_apart > probe_count / 2;
}

}  // namespace

void RayCaster::closest_hits(std::span<const Ray> rays, std::span<Hit> hits) {
  assert(rays.size() == hits.size());
  const auto trace_alone = [&](size_t first, size_t end) {
    const bool may_wait =
        accel_.wide && accel_.wide->bytes() > least_tree_to_wait_for_bytes &&
        accel_.wide->expected_steps < most_steps_to_wait_for &&
        are_scattered(rays.subspan(first, end - first), accel_.wide->max_coordinate);
    while (first < end) {
      if (may_wait) {
        const size_t done = closest_hits_in_flight(*accel_.wide, rays.subspan(first, end - first),
                                                   stop_, hits.subspan(first, end - first));
        ray_count_ += done;
        first += done;
        if (first == end) return;
      }
      hits[first] = closest_hit(rays[first]);
      ++first;
    }
  };
  size_t alone = 0;  // rays from here on are not answered yet
  for (size_t first = 0; first < rays.size();) {
    const size_t end = bundle_end(first, rays.size());
    const auto bundle = rays.subspan(first, end - first);
    if (accel_.wide && may_share_origin(bundle) && !stop_.requested() &&
        closest_hits_bundle(*accel_.wide, bundle, stop_, hits.subspan(first, end - first))) {
      trace_alone(alone, first);
      ray_count_ += bundle.size();
      alone = end;
    }
    first = end;
  }
  trace_alone(alone, rays.size());
}

void RayCaster::occluded(std::span<const Ray> rays, std::span<uint8_t> is_occluded) {
  assert(rays.size() == is_occluded.size());
  size_t failures = 0, bundles_to_skip = 0;  // where bundles don't pay, few are tried
  for (size_t first = 0; first < rays.size();) {
    const size_t end = bundle_end(first, rays.size());
    const auto bundle = rays.subspan(first, end - first);
    if (accel_.wide && bundle.size() >= least_bundle && !stop_.requested() &&
        bundles_to_skip == 0 &&
        occluded_bundle(*accel_.wide, bundle, stop_, is_occluded.subspan(first, end - first))) {
      ray_count_ += bundle.size();
      failures = 0;
    } else {
      if (bundles_to_skip > 0) {
        --bundles_to_skip;
      } else {
        bundles_to_skip = (size_t{1} << failures) - 1;
        failures = std::min(failures + 1, most_failures);
      }
      for (size_t i = first; i < end; ++i) is_occluded[i] = occluded(rays[i]) ? 1 : 0;
    }
    first = end;
  }
}

}  // namespace tracer
