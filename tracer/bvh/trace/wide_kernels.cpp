// SPDX-License-Identifier: MIT
#include "tracer/bvh/trace/wide_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracer/bvh/trace/wide_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tracer/bvh/trace/wide_traverse-inl.h"

#if HWY_ONCE
namespace tracer {
namespace {
HWY_EXPORT(KernelWidth);
HWY_EXPORT(ClosestHit);
HWY_EXPORT(Occluded);
HWY_EXPORT(CountClosestHit);
HWY_EXPORT(CountOccluded);
}  // namespace

int wide_kernel_width() {
  return HWY_DYNAMIC_DISPATCH(KernelWidth)();
}

bool closest_hit_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop, Hit& hit) {
  return HWY_DYNAMIC_DISPATCH(ClosestHit)(tree, ray, stop, hit);
}

bool occluded_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop, Hit& hit) {
  return HWY_DYNAMIC_DISPATCH(Occluded)(tree, ray, stop, hit);
}

bool closest_hit_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop, Hit& hit,
                      VisitCounts& counts) {
  return HWY_DYNAMIC_DISPATCH(CountClosestHit)(tree, ray, stop, hit, counts);
}

bool occluded_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop, Hit& hit,
                   VisitCounts& counts) {
  return HWY_DYNAMIC_DISPATCH(CountOccluded)(tree, ray, stop, hit, counts);
}

}  // namespace tracer
#endif
