// SPDX-License-Identifier: MIT
#include "tracer/render/camera_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracer/render/camera_rays.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tracer/render/camera_rays-inl.h"

#if HWY_ONCE
namespace tracer {
namespace {
HWY_EXPORT(CameraRays);
}  // namespace

void camera_rays(const CameraFrame& camera, std::span<const Vec2i> pixels,
                 std::span<Sampler> samplers, std::span<Ray> rays) {
  HWY_DYNAMIC_DISPATCH(CameraRays)(camera, pixels, samplers, rays);
}

}  // namespace tracer
#endif
