// SPDX-License-Identifier: MIT
#include "tracer/scene/light_tree.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracer/scene/light_tree.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tracer/scene/light_tree-inl.h"

#if HWY_ONCE
namespace tracer {
namespace {
HWY_EXPORT(PickLights);
HWY_EXPORT(LightProbability);
}  // namespace

LightReceiver LightTree::placed(const LightReceiver& receiver) const {
  return {Vec3f((Vec3d(receiver.position) - center_) * scale_), receiver.normal};
}

void LightTree::pick(std::span<const LightReceiver> receivers, std::span<const double> u,
                     std::span<Pick> picks) const {
  HWY_DYNAMIC_DISPATCH(PickLights)(*this, receivers, u, picks);
}

double LightTree::probability(const LightReceiver& receiver, uint32_t light) const {
  return HWY_DYNAMIC_DISPATCH(LightProbability)(*this, receiver, light);
}

}  // namespace tracer
#endif
