// SPDX-License-Identifier: MIT
#if defined(TRACER_CAMERA_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_CAMERA_RAYS_INL_H
#undef TRACER_CAMERA_RAYS_INL_H
#else
#define TRACER_CAMERA_RAYS_INL_H
#endif

#include <array>

#include "tracer/render/sampler_lanes-inl.h"
#include "tracer/scene/camera.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {

// NOLINTNEXTLINE(misc-definitions-in-headers): each instruction set has a namespace of its own.
void CameraRays(const CameraFrame& camera, std::span<const Vec2i> pixels,
                std::span<Sampler> samplers, std::span<Ray> rays) {
  constexpr size_t max_size = SampleBlock::max_size;
  alignas(64) std::array<double, max_size> x, y;
  std::array<uint32_t, max_size> samples;
  for (size_t i = 0; i < pixels.size(); ++i) samples[i] = static_cast<uint32_t>(i);
  SamplerLanes lanes(samplers);
  lanes.next_2d(samples.data(), pixels.size(), x.data(), y.data());
  lanes.finish();
  // camera_ray, with its operations in their order.
  for (size_t i = 0; i < pixels.size(); ++i) {
    x[i] = (pixels[i].x + x[i]) - camera.center_px.x;
    y[i] = (pixels[i].y + y[i]) - camera.center_px.y;
  }
  const auto set = [](const Vec3d& v) {
    return Vector3<Lanes>{Lanes(v.x), Lanes(v.y), Lanes(v.z)};
  };
  const Vector3<Lanes> forward = set(camera.forward);
  const Vector3<Lanes> right = set(camera.right_step), down = set(camera.down_step);
  alignas(64) std::array<float, max_size> direction_x, direction_y, direction_z;
  for (size_t i = 0; i < pixels.size(); i += hn::Lanes(LaneTag())) {
    const Vector3<Lanes> direction =
        forward + Lanes::load(&x[i]) * right + Lanes::load(&y[i]) * down;
    const Vector3<Lanes> unit = (Lanes(1) / sqrt(dot(direction, direction))) * direction;
    unit.x.store(&direction_x[i]);
    unit.y.store(&direction_y[i]);
    unit.z.store(&direction_z[i]);
  }
  for (size_t i = 0; i < pixels.size(); ++i) {
    rays[i] = {.origin = camera.origin,
               .direction = {direction_x[i], direction_y[i], direction_z[i]}};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
