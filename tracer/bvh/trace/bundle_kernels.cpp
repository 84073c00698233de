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
HWY_EXPORT(ClosestHitsBundle);
HWY_EXPORT(OccludedBundle);
HWY_EXPORT(ClosestHitsStream);
HWY_EXPORT(OccludedStream);
}  // namespace

bool closest_hits_bundle(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                         std::span<Hit> hits) {
  return HWY_DYNAMIC_DISPATCH(ClosestHitsBundle)(tree, rays, stop, hits);
}

bool occluded_bundle(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                     std::span<uint8_t> is_occluded) {
  return HWY_DYNAMIC_DISPATCH(OccludedBundle)(tree, rays, stop, is_occluded);
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
