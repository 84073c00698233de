// SPDX-License-Identifier: MIT
#include "tests/bench/compare/moeller_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/compare/moeller_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tests/bench/compare/moeller_trumbore-inl.h"
#include "tracer/bvh/trace/wide_stream-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
namespace {
#if HWY_TARGET == HWY_SCALAR

bool MoellerClosestHit(const WideTree&, const Ray&, const StopFlag&, Hit&) {
  return false;
}
bool MoellerOccluded(const WideTree&, const Ray&, const StopFlag&, Hit&) {
  return false;
}
size_t MoellerClosestHits(const WideTree&, std::span<const Ray>, const StopFlag&, std::span<Hit>) {
  return 0;
}
size_t MoellerOccludedRays(const WideTree&, std::span<const Ray>, const StopFlag&,
                           std::span<uint8_t>) {
  return 0;
}

#else

bool MoellerClosestHit(const WideTree& tree, const Ray& ray, const StopFlag& stop, Hit& hit) {
  return answer<Query::closest_hit, MoellerTrumboreLeaf>(tree, ray, stop, NoProbe{}, hit);
}

bool MoellerOccluded(const WideTree& tree, const Ray& ray, const StopFlag& stop, Hit& hit) {
  return answer<Query::occluded, AnyMoellerTrumboreLeaf>(tree, ray, stop, NoProbe{}, hit);
}

size_t MoellerClosestHits(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                          std::span<Hit> hits) {
  return answer_stream<Query::closest_hit, MoellerTrumboreLeaf>(
      tree, rays, stop, [&](size_t ray, const Hit& hit) { hits[ray] = hit; });
}

size_t MoellerOccludedRays(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                           std::span<uint8_t> is_occluded) {
  return answer_stream<Query::occluded, AnyMoellerTrumboreLeaf>(
      tree, rays, stop,
      [&](size_t ray, const Hit& hit) { is_occluded[ray] = hit.is_hit() ? 1 : 0; });
}

#endif
}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tracer {
namespace {
HWY_EXPORT(MoellerClosestHit);
HWY_EXPORT(MoellerOccluded);
HWY_EXPORT(MoellerClosestHits);
HWY_EXPORT(MoellerOccludedRays);
}  // namespace
}  // namespace tracer

namespace bench {

using tracer::Hit;
using tracer::Ray;
using tracer::StopFlag;
using tracer::WideTree;

bool closest_hit_moeller(const WideTree& tree, const Ray& ray, const StopFlag& stop, Hit& hit) {
  using namespace tracer;
  return HWY_DYNAMIC_DISPATCH(MoellerClosestHit)(tree, ray, stop, hit);
}

bool occluded_moeller(const WideTree& tree, const Ray& ray, const StopFlag& stop, Hit& hit) {
  using namespace tracer;
  return HWY_DYNAMIC_DISPATCH(MoellerOccluded)(tree, ray, stop, hit);
}

size_t closest_hits_stream_moeller(const WideTree& tree, std::span<const Ray> rays,
                                   const StopFlag& stop, std::span<Hit> hits) {
  using namespace tracer;
  return HWY_DYNAMIC_DISPATCH(MoellerClosestHits)(tree, rays, stop, hits);
}

size_t occluded_stream_moeller(const WideTree& tree, std::span<const Ray> rays,
                               const StopFlag& stop, std::span<uint8_t> is_occluded) {
  using namespace tracer;
  return HWY_DYNAMIC_DISPATCH(MoellerOccludedRays)(tree, rays, stop, is_occluded);
}

}  // namespace bench
#endif
