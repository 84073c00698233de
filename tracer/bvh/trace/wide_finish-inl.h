// SPDX-License-Identifier: MIT
// t, u and v of a bundle's hits, by intersect_triangle for as many rays at once as there are
// doubles in a vector: the same operations in the same order, so the same bits.
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

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR

using Doubles = hn::CappedTag<double, 8>;
using DoubleLanes = hn::Vec<Doubles>;

struct VectorLanes {
  DoubleLanes x, y, z;

  friend HWY_INLINE VectorLanes operator-(const VectorLanes& a, const VectorLanes& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
  }
};

HWY_INLINE DoubleLanes dot(const VectorLanes& a, const VectorLanes& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE VectorLanes cross(const VectorLanes& a, const VectorLanes& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}

HWY_INLINE DoubleLanes max_abs(const VectorLanes& v) {
  return hn::Max(hn::Max(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
}

HWY_INLINE DoubleLanes sum_abs(const VectorLanes& v) {
  return hn::Add(hn::Add(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
}

struct TriangleHitLanes {
  DoubleLanes t, u, v;
  hn::Mask<Doubles> is_certain;
};

/// Of rays that are known to hit. Where `is_certain`, t, u, v are those of intersect_triangle.
HWY_INLINE TriangleHitLanes intersect_triangles(const VectorLanes& origin,
                                                const VectorLanes& direction, const VectorLanes& v0,
                                                const VectorLanes& v1, const VectorLanes& v2) {
  const Doubles d;
  const auto to_v0 = v0 - origin;
  const auto edge1 = v1 - v0;
  const auto edge2 = v2 - v0;
  const auto moment = cross(direction, to_v0);
  const auto v = dot(edge2, moment);
  const auto w = hn::Neg(dot(edge1, moment));
  const auto normal = cross(edge2, edge1);
  const auto determinant = dot(direction, normal);
  const auto weight0 = hn::Sub(hn::Sub(determinant, v), w);
  const auto sum = hn::Add(hn::Add(weight0, v), w);
  const auto numerator = dot(to_v0, normal);

  // Not below the bounds there, whatever the order of their products.
  const auto length1 = max_abs(edge1);
  const auto length2 = max_abs(edge2);
  const auto length = hn::Max(length1, length2);
  const auto speed = sum_abs(direction);
  const auto bound = hn::Mul(hn::Mul(hn::Set(d, 37 * 0x1p-53), hn::Mul(speed, length)),
                             hn::Add(max_abs(to_v0), length));
  const auto least_weight = hn::Min(hn::Min(hn::Abs(weight0), hn::Abs(v)), hn::Abs(w));
  const auto area = hn::Mul(length1, length2);
  constexpr double quotient_error = 19 * 0x1p-53 / (0.9 * 0x1p-33);
  const auto least_area = hn::Mul(area, hn::Set(d, quotient_error));
  const auto is_certain =
      hn::And(hn::Gt(least_weight, bound),
              hn::And(hn::Gt(hn::Abs(numerator), hn::Mul(least_area, sum_abs(to_v0))),
                      hn::Gt(hn::Abs(determinant), hn::Mul(least_area, speed))));

  const auto weight1 = hn::Div(v, sum);
  const auto weight2 = hn::Min(hn::Div(w, sum), hn::Sub(hn::Set(d, 1.0), weight1));
  return {hn::Div(numerator, determinant), weight1, weight2, is_certain};
}

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

/// Corners of the triangles that won, ray by ray.
struct WinnerCorners {
  alignas(64) float rows[9][hn::MaxLanes(Doubles())];

  VectorLanes corner(size_t index) const {
    const Doubles d;
    const hn::Rebind<float, Doubles> df;
    const auto load = [&](size_t row) { return hn::PromoteTo(d, hn::Load(df, rows[row])); };
    return {load(3 * index), load(3 * index + 1), load(3 * index + 2)};
  }
  Vec3f vertex(size_t index, size_t ray) const {
    return {rows[3 * index][ray], rows[3 * index + 1][ray], rows[3 * index + 2][ray]};
  }
};

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
  WinnerCorners corners;
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
  const uint32_t certain = bits_of(d, found.is_certain);
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
