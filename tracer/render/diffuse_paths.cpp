// SPDX-License-Identifier: MIT
#include "tracer/render/diffuse_paths.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracer/render/diffuse_paths.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tracer/render/diffuse_paths-inl.h"
#include "tracer/scene/profile.h"

#if HWY_ONCE
namespace tracer {
namespace {
HWY_EXPORT(DiffusePathsOf);
}  // namespace

bool can_find_diffuse_paths(const World& world, const RenderSettings& settings) {
  return make_profile(*world.scene).is_plain() && !world.environment && settings.clamp == 0;
}

void diffuse_paths(const World& world, RayCaster& rays, const RenderSettings& settings,
                   const SampleBlock& block) {
  HWY_DYNAMIC_DISPATCH(DiffusePathsOf)(world, rays, settings, block);
}

}  // namespace tracer
#endif
