// SPDX-License-Identifier: MIT
// t, u and v of a bundle's hits.
#if defined(TRACER_WIDE_FINISH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_WIDE_FINISH_INL_H
#undef TRACER_WIDE_FINISH_INL_H
#else
#define TRACER_WIDE_FINISH_INL_H
#endif

#include <algorithm>
#include <bit>
#include <span>

#include <hwy/highway.h>

#include "tracer/bvh/trace/bundle_rays-inl.h"
#include "tracer/bvh/trace/exact_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR

HWY_INLINE VectorLanes directions_of(const Bundle& bundle, size_t first) {
  const Doubles d;
  const hn::Rebind<float, Doubles> df;
  const auto load = [&](const float* component) {
    return hn::PromoteTo(d, hn::LoadU(df, component + first));
  };
  DoubleLanes lanes[3];
  lanes[bundle.axis_x] = load(bundle.direction_x);
  lanes[bundle.axis_y] = load(bundle.direction_y);
  lanes[bundle.axis_z] = hn::Mul(load(bundle.speed), hn::Set(d, double{bundle.toward}));
  return {lanes[0], lanes[1], lanes[2]};
}

/// The winners of as many rays from `first` on as there are doubles in a vector.
HWY_INLINE void finish_winners(const WideTree& tree, std::span<const Ray> rays,
                               const Bundle& bundle, size_t first, std::span<Hit> hits) {
  const Doubles d;
  const hn::Rebind<float, Doubles> df;
  const size_t width = hn::Lanes(Floats());
  const size_t count = hn::Lanes(d);
  const auto rows_of = [&](size_t winner) {
    return tree.blocks.row(0) + winner / width * (WideTree::rows_a_block * width) + winner % width;
  };
  const hn::Rebind<uint32_t, Doubles> du;
  const auto winners = hn::LoadU(du, bundle.winner + first);
  uint32_t won = ~bits_of(du, hn::Eq(winners, hn::Set(du, no_winner))) & ((2u << (count - 1)) - 1);
  if (won == 0) return;
  const auto some_ray = static_cast<size_t>(std::countr_zero(won));
  const uint32_t some_winner = bundle.winner[first + some_ray];
  CornerLanes corners;
  if ((~bits_of(du, hn::Eq(winners, hn::Set(du, some_winner))) & won) == 0) {
    const float* v = rows_of(some_winner);
    for (size_t row = 0; row < 9; ++row)
      hn::Store(hn::Set(df, v[row * width]), df, corners.rows[row]);
  } else {
    for (size_t i = 0; i < count; ++i) {
      const float* v = rows_of(bundle.winner[first + ((won >> i & 1) != 0 ? i : some_ray)]);
      for (size_t row = 0; row < 9; ++row) corners.rows[row][i] = v[row * width];
    }
  }
  const auto spread = [&](float value) { return hn::Set(d, double{value}); };
  const VectorLanes origin{spread(bundle.point.x), spread(bundle.point.y), spread(bundle.point.z)};
  const TriangleHitLanes found =
      intersect_triangles(origin, directions_of(bundle, first), corners.corner(0),
                          corners.corner(1), corners.corner(2));
  alignas(64) double t[hn::MaxLanes(Doubles())], weight1[hn::MaxLanes(Doubles())],
      weight2[hn::MaxLanes(Doubles())];
  hn::Store(found.t, d, t);
  hn::Store(found.u, d, weight1);
  hn::Store(found.v, d, weight2);
  const uint32_t certain = bits_of(d, hn::And(found.is_certain, found.is_hit));
  for (; won != 0; won &= won - 1) {
    const auto i = static_cast<size_t>(std::countr_zero(won));
    const float* v = rows_of(bundle.winner[first + i]);
    Hit hit{t[i], weight1[i], weight2[i], std::bit_cast<uint32_t>(v[9 * width])};
    if (HWY_UNLIKELY((certain >> i & 1) == 0)) {
      const auto exact = intersect_triangle(rays[first + i], corners.vertex(0, i),
                                            corners.vertex(1, i), corners.vertex(2, i));
      hit = exact ? Hit{exact->t, exact->u, exact->v, hit.primitive} : Hit{};
    }
    if (hit.is_closer_than(hits[first + i])) hits[first + i] = hit;
  }
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
