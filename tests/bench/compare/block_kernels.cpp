// SPDX-License-Identifier: MIT
// Ray-triangle tests for all triangles of a block at once, compiled for each instruction set.
#include <bit>
#include <memory>

#include "tests/bench/compare/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/compare/block_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tests/bench/compare/watertight_block-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
namespace {

using bench::Found;
using bench::KernelBlock;
using bench::TestRays;

#if HWY_TARGET == HWY_SCALAR

TestRays PrepareMoellerTrumbore(const KernelBlock&, std::span<const Ray>) {
  return {};
}
TestRays PrepareWoop(const KernelBlock&, std::span<const Ray>) {
  return {};
}
TestRays PreparePluecker(const KernelBlock&, std::span<const Ray>) {
  return {};
}
TestRays PrepareDouble(const KernelBlock&, std::span<const Ray>) {
  return {};
}
TestRays PrepareExact(const KernelBlock&, std::span<const Ray>) {
  return {};
}

#else

/// A ray with all that a traversal knows of it where it comes to the block.
struct ArrivingRay {
  const Ray* ray;
  RayConstants constants;
  float entry;  // into the leaf's box
  float t_far;  // of the constants
  // What tests that know no moved origins take.
  RayConstants unmoved;
  float unmoved_t_far;
  bool arrives;
};

RayConstants with_own_origin(const RayConstants& moved, const Ray& ray) {
  RayConstants c = moved;
  const float* const origin = &ray.origin.x;
  for (int i = 0; i < 3; ++i) c.leaf_origin[i] = origin[c.leaf_row[i] / hn::Lanes(Floats())];
  c.t_min = static_cast<float>(ray.t_min);
  return c;
}

ArrivingRay arriving(const KernelBlock& block, const Ray& ray) {
  ArrivingRay arrival{&ray, {}, 0, 0, {}, static_cast<float>(ray.t_max), false};
  if (!prepare(block.tree, ray, arrival.constants)) return arrival;
  arrival.t_far = stop_at(arrival.constants, ray.t_max);
  arrival.unmoved = with_own_origin(arrival.constants, ray);
  const float* root = block.tree.nodes.row(0);
  const auto [entry, is_hit] = with_slabs(arrival.constants, [&]<Slabs slabs>() {
    return hit_slabs<slabs>(root, arrival.constants, arrival.t_far);
  });
  if (bits_of(is_hit) == 0) return arrival;
  alignas(64) float entries[hn::MaxLanes(Floats())];
  hn::Store(entry, Floats(), entries);
  arrival.entry = entries[std::countr_zero(bits_of(is_hit))];
  arrival.arrives = true;
  return arrival;
}

/// Calls test(rows, info, ray, found) for each ray that meets the block's box.
template <class Test>
TestRays prepare_block(const KernelBlock& block, std::span<const Ray> rays, const Test& test) {
  auto arrivals = std::make_shared<std::vector<ArrivingRay> >();
  for (const Ray& ray : rays) arrivals->push_back(arriving(block, ray));
  return [&block, arrivals, test](std::span<Found> found) {
    const float* rows = block.tree.blocks.row(0);
    const WideTree::BlockInfo& info = block.tree.block_infos.front();
    for (size_t i = 0; i < arrivals->size(); ++i) {
      const ArrivingRay& ray = (*arrivals)[i];
      found[i].hits = 0;
      if (HWY_LIKELY(ray.arrives)) test(rows, info, ray, found[i]);
    }
  };
}

/// Divides where anything is hit.
template <class Met>
HWY_INLINE void keep_hits(const Met& met, const WideTree::BlockInfo& info, Found& found) {
  const uint32_t filled = (2u << (info.count - 1)) - 1;
  found.hits = bits_of(met.is_hit) & filled;
  if (HWY_LIKELY(found.hits == 0)) return;
  alignas(64) float t[hn::MaxLanes(Floats())];
  hn::Store(hn::Div(met.numerator, met.determinant), Floats(), t);
  for (uint32_t bits = found.hits; bits != 0; bits &= bits - 1) {
    const int lane = std::countr_zero(bits);
    found.t[lane] = t[lane];
  }
}

TestRays PrepareMoellerTrumbore(const KernelBlock& block, std::span<const Ray> rays) {
  return prepare_block(
      block, rays,
      [](const float* rows, const WideTree::BlockInfo& info, const ArrivingRay& arrival,
         Found& found) {
        const Floats d;
        keep_hits(meet_moeller_trumbore(
                      d, spread(arrival.ray->origin), spread(arrival.ray->direction),
                      corners_of(rows, 0), corners_of(rows, 1), corners_of(rows, 2),
                      hn::Set(d, arrival.unmoved.t_min), hn::Set(d, arrival.unmoved_t_far)),
                  info, found);
      });
}

TestRays PrepareWoop(const KernelBlock& block, std::span<const Ray> rays) {
  return prepare_block(block, rays,
                       [](const float* rows, const WideTree::BlockInfo& info,
                          const ArrivingRay& arrival, Found& found) {
                         keep_hits(meet_woop(rows, arrival.unmoved, arrival.unmoved_t_far), info,
                                   found);
                       });
}

TestRays PreparePluecker(const KernelBlock& block, std::span<const Ray> rays) {
  return prepare_block(
      block, rays,
      [](const float* rows, const WideTree::BlockInfo& info, const ArrivingRay& arrival,
         Found& found) {
        keep_hits(meet_pluecker(rows, *arrival.ray, arrival.unmoved.t_min, arrival.unmoved_t_far),
                  info, found);
      });
}

TestRays PrepareDouble(const KernelBlock& block, std::span<const Ray> rays) {
  return prepare_block(
      block, rays,
      [](const float* rows, const WideTree::BlockInfo& info, const ArrivingRay& arrival,
         Found& found) { meet_in_double(rows, info.count, *arrival.ray, found.hits, found.t); });
}

template <Slabs slabs>
HWY_INLINE void meet_exactly(const float* rows, const WideTree::BlockInfo& info,
                             const ArrivingRay& arrival, Found& found) {
  const auto hits = ExactLeaf::find<Query::closest_hit, slabs, Flow::leaves_early>(
      rows, info, arrival.constants, *arrival.ray, arrival.entry, {arrival.t_far, -1});
  for (uint32_t bits = hits.possible; bits != 0; bits &= bits - 1) {
    const int lane = std::countr_zero(bits);
    const Hit hit = ExactLeaf::hit(rows, hits, lane, *arrival.ray);
    if (!hit.is_hit()) continue;
    found.hits |= 1u << lane;
    found.t[lane] = hit.t;
  }
}

// The production leaf.
TestRays PrepareExact(const KernelBlock& block, std::span<const Ray> rays) {
  return prepare_block(block, rays,
                       [](const float* rows, const WideTree::BlockInfo& info,
                          const ArrivingRay& arrival, Found& found) {
                         with_slabs(arrival.constants, [&]<Slabs slabs>() {
                           meet_exactly<slabs>(rows, info, arrival, found);
                         });
                       });
}

#endif
}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tracer {
namespace {
HWY_EXPORT(PrepareMoellerTrumbore);
HWY_EXPORT(PrepareWoop);
HWY_EXPORT(PreparePluecker);
HWY_EXPORT(PrepareDouble);
HWY_EXPORT(PrepareExact);

using bench::Form;
using bench::Kernel;
using bench::KernelBlock;
using bench::TestRays;

TestRays prepare_moeller_trumbore(const KernelBlock& block, std::span<const Ray> rays) {
  return HWY_DYNAMIC_DISPATCH(PrepareMoellerTrumbore)(block, rays);
}
TestRays prepare_woop(const KernelBlock& block, std::span<const Ray> rays) {
  return HWY_DYNAMIC_DISPATCH(PrepareWoop)(block, rays);
}
TestRays prepare_pluecker(const KernelBlock& block, std::span<const Ray> rays) {
  return HWY_DYNAMIC_DISPATCH(PreparePluecker)(block, rays);
}
TestRays prepare_double(const KernelBlock& block, std::span<const Ray> rays) {
  return HWY_DYNAMIC_DISPATCH(PrepareDouble)(block, rays);
}
TestRays prepare_exact(const KernelBlock& block, std::span<const Ray> rays) {
  return HWY_DYNAMIC_DISPATCH(PrepareExact)(block, rays);
}

constexpr Kernel block_table[] = {
    {"Möller-Trumbore", Form::simd, prepare_moeller_trumbore, prepare_moeller_trumbore},
    {"Woop 2013", Form::simd, prepare_woop, prepare_woop},
    {"Plücker", Form::simd, prepare_pluecker, prepare_pluecker},
    {"Möller-Trumbore in double", Form::simd, prepare_double, prepare_double},
    {"Boxwood", Form::simd, prepare_exact, prepare_exact},
};

}  // namespace
}  // namespace tracer

namespace bench {

std::span<const Kernel> block_kernels() {
  return tracer::block_table;
}

}  // namespace bench
#endif
