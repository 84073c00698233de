// SPDX-License-Identifier: MIT
#include "tracer/bvh/trace/wide_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracer/bvh/trace/wide_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tracer/bvh/trace/wide_traverse-inl.h"

#if HWY_ONCE
#include <algorithm>
#include <cmath>

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

bool is_in_kernel_range(const WideTree& tree, const Ray& ray) {
  const auto largest = [](const Vec3f& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  };
  const float direction = largest(ray.direction);
  return direction > 0x1p-36f && direction < 0x1p36f && largest(ray.origin) < 0x1p36f &&
         tree.max_coordinate > 0x1p-36f && tree.max_coordinate < 0x1p36f;
}

Hit closest_hit_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop) {
  return HWY_DYNAMIC_DISPATCH(ClosestHit)(tree, ray, stop);
}

bool occluded_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop) {
  return HWY_DYNAMIC_DISPATCH(Occluded)(tree, ray, stop);
}

Hit closest_hit_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop,
                     VisitCounts& counts) {
  return HWY_DYNAMIC_DISPATCH(CountClosestHit)(tree, ray, stop, counts);
}

bool occluded_wide(const WideTree& tree, const Ray& ray, const StopFlag& stop,
                   VisitCounts& counts) {
  return HWY_DYNAMIC_DISPATCH(CountOccluded)(tree, ray, stop, counts);
}

}  // namespace tracer
#endif
