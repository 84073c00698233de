// SPDX-License-Identifier: MIT
// Embree's own functions on a scene of one block's triangles.
#include <memory>

#include "tests/bench/compare/embree_scene.h"
#include "tests/bench/compare/kernels.h"

namespace bench {

#ifdef BOXWOOD_EMBREE
namespace {

using tracer::Ray;

/// What the filter below finds of one ray. `context` comes first, so that Embree's pointer to it
/// leads to the whole.
struct Collector {
  RTCIntersectContext context;
  Found* found;
};

// Notes each hit, then lets it pass.
void collect(const RTCFilterFunctionNArguments* arguments) {
  auto* collector = reinterpret_cast<Collector*>(arguments->context);
  const unsigned primitive = RTCHitN_primID(arguments->hit, arguments->N, 0);
  collector->found->hits |= 1u << primitive;
  collector->found->t[primitive] = double{RTCRayN_tfar(arguments->ray, arguments->N, 0)};
  arguments->valid[0] = 0;
}

template <EmbreeMode mode>
TestRays call_nearest(const KernelBlock& block, std::span<const Ray> rays) {
  auto scene = std::make_shared<EmbreeScene>(*block.mesh, RTC_BUILD_QUALITY_MEDIUM, mode);
  scene->build();
  auto queries = std::make_shared<std::vector<RTCRayHit>>();
  for (const Ray& ray : rays) queries->push_back(make_query(ray));
  return [scene, queries](std::span<Found> found) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t i = 0; i < queries->size(); ++i) {
      RTCRayHit query = (*queries)[i];
      rtcIntersect1(scene->scene(), &context, &query);
      found[i].hits = 0;
      if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
      found[i].hits = 1u << query.hit.primID;
      found[i].t[query.hit.primID] = double{query.ray.tfar};
    }
  };
}

template <EmbreeMode mode>
TestRays call_for_all(const KernelBlock& block, std::span<const Ray> rays) {
  auto scene = std::make_shared<EmbreeScene>(*block.mesh, RTC_BUILD_QUALITY_MEDIUM, mode);
  RTCGeometry geometry = rtcGetGeometry(scene->scene(), 0);
  rtcSetGeometryIntersectFilterFunction(geometry, collect);
  rtcCommitGeometry(geometry);
  scene->build();
  return [scene, rays](std::span<Found> found) {
    Collector collector;
    rtcInitIntersectContext(&collector.context);
    for (size_t i = 0; i < rays.size(); ++i) {
      found[i].hits = 0;
      collector.found = &found[i];
      RTCRayHit query = make_query(rays[i]);
      rtcIntersect1(scene->scene(), &collector.context, &query);
    }
  };
}

constexpr Kernel table[] = {
    {"Embree", Form::call, call_nearest<EmbreeMode::standard>, call_for_all<EmbreeMode::standard>},
    {"Embree ROBUST", Form::call, call_nearest<EmbreeMode::robust>,
     call_for_all<EmbreeMode::robust>},
};

}  // namespace

std::span<const Kernel> embree_calls() {
  return table;
}
#else
std::span<const Kernel> embree_calls() {
  return {};
}
#endif

}  // namespace bench
