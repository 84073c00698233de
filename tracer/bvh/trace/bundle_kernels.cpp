// SPDX-License-Identifier: MIT
#include "tracer/bvh/trace/bundle_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracer/bvh/trace/bundle_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tracer/bvh/trace/wide_bundle-inl.h"
#include "tracer/bvh/trace/wide_stream-inl.h"

#if HWY_ONCE
namespace tracer {
namespace {
HWY_EXPORT(ClosestHitsBundles);
HWY_EXPORT(OccludedBundles);
HWY_EXPORT(ClosestHitsStream);
HWY_EXPORT(OccludedStream);
}  // namespace

BundleVerdicts closest_hits_bundles(const WideTree& tree, std::span<const Ray> rays,
                                    size_t leaves_a_ray, const StopFlag& stop,
                                    std::span<Hit> hits) {
  return HWY_DYNAMIC_DISPATCH(ClosestHitsBundles)(tree, rays, leaves_a_ray, stop, hits);
}

BundleVerdicts occluded_bundles(const WideTree& tree, std::span<const Ray> rays,
                                size_t leaves_a_ray, const StopFlag& stop,
                                std::span<uint8_t> is_occluded) {
  return HWY_DYNAMIC_DISPATCH(OccludedBundles)(tree, rays, leaves_a_ray, stop, is_occluded);
}

size_t closest_hits_stream(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                           std::span<Hit> hits) {
  return HWY_DYNAMIC_DISPATCH(ClosestHitsStream)(tree, rays, stop, hits);
}

size_t occluded_stream(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                       std::span<uint8_t> is_occluded) {
  return HWY_DYNAMIC_DISPATCH(OccludedStream)(tree, rays, stop, is_occluded);
}

}  // namespace tracer
#endif
