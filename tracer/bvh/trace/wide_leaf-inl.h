// SPDX-License-Identifier: MIT
// A float filter with a proved bound for a block of triangles: which of them a ray may hit.
// docs/numerics.md derives the bound.
#if defined(TRACER_WIDE_LEAF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_WIDE_LEAF_INL_H
#undef TRACER_WIDE_LEAF_INL_H
#else
#define TRACER_WIDE_LEAF_INL_H
#endif

#include <cfloat>

#include <hwy/highway.h>

#include "tracer/bvh/trace/wide_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR

/// Whether code leaves early where one ray's work is done, which is hard to predict, or goes
/// straight on, so that the processor begins with the next ray's.
enum class Flow { leaves_early, straight };

/// Of a block's lanes.
enum class Verdicts { possible, possible_and_certain };

/// Lanes of a block that the ray may hit, and of those the lanes that it certainly hits at a
/// distance that counts, or none where they are not asked for.
struct BlockHits {
  uint32_t possible;
  uint32_t certain;
};

/// The sheared edge functions [Woop 2013] of the float-rounded vertices, with `bound` at least
/// their error.
template <Verdicts verdicts, Slabs slabs, Flow flow>
HWY_INLINE BlockHits hit_triangles(const float* HWY_RESTRICT block, const WideTree::BlockInfo& info,
                                   const RayConstants& c, float entry, float t_far) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  // Both hold for every vertex of a leaf whose padded box the ray meets at `entry`. The same in all
  // lanes: they are wanted there, and from fused steps.
  constexpr bool is_moved = slabs == Slabs::moved;
  const auto largest_component = hn::Set(d, c.largest_component);
  const auto reach = hn::Set(d, info.extent + c.slack);
  const auto extent = slabs == Slabs::fused
                          ? reach
                          : hn::MulAdd(hn::Set(d, entry), hn::Set(d, 33 * u * c.largest_component),
                                       hn::Mul(reach, hn::Set(d, 1 + 64 * u)));
  const auto distance = hn::MulAdd(hn::Set(d, entry), largest_component, extent);
  const auto origin_error = hn::Set(d, is_moved ? 2 * c.origin_error : 0);
  const auto vertex_error = hn::MulAdd(hn::Set(d, 10 * u), distance, origin_error);
  // 17/16 (4e (2v + 16 u e) + 2 v v), e the extent and v a vertex's error.
  const auto bound = hn::MulAdd(
      hn::Mul(hn::Set(d, 8.5f), extent), hn::MulAdd(hn::Set(d, 8 * u), extent, vertex_error),
      hn::MulAdd(hn::Mul(hn::Set(d, 2.125f), vertex_error), vertex_error,
                 hn::Set(d, FLT_MIN)));  // products below it round absolutely

  const auto origin_x = hn::Set(d, c.leaf_origin[0]);
  const auto origin_y = hn::Set(d, c.leaf_origin[1]);
  const auto origin_z = hn::Set(d, c.leaf_origin[2]);
  const auto shear_x = hn::Set(d, c.shear[0]);
  const auto shear_y = hn::Set(d, c.shear[1]);
  Lanes x[3], y[3], z[3];
  for (size_t corner = 0; corner < 3; ++corner) {
    const float* rows = block + 3 * corner * width;
    z[corner] = hn::Sub(hn::Load(d, rows + c.leaf_row[2]), origin_z);
    x[corner] =
        hn::NegMulAdd(shear_x, z[corner], hn::Sub(hn::Load(d, rows + c.leaf_row[0]), origin_x));
    y[corner] =
        hn::NegMulAdd(shear_y, z[corner], hn::Sub(hn::Load(d, rows + c.leaf_row[1]), origin_y));
  }
  const auto edge = [](const Lanes& ax, const Lanes& ay, const Lanes& bx, const Lanes& by) {
    return hn::MulSub(ax, by, hn::Mul(ay, bx));
  };
  const auto e0 = edge(x[2], y[2], x[1], y[1]);
  const auto e1 = edge(x[0], y[0], x[2], y[2]);
  const auto e2 = edge(x[1], y[1], x[0], y[0]);
  const auto low = hn::Min(hn::Min(e0, e1), e2);
  const auto high = hn::Max(hn::Max(e0, e1), e2);
  const auto negative = hn::Neg(bound);
  // Outside where one edge function is certainly negative and another certainly positive.
  const uint32_t filled = (2u << (info.count - 1)) - 1;
  const auto outside = hn::And(hn::Lt(low, negative), hn::Gt(high, bound));
  const uint32_t crossed = ~bits_of(outside) & filled;
  if constexpr (flow == Flow::leaves_early) {
    if (HWY_LIKELY(crossed == 0)) return {0, 0};
  }
  // What is hit lies at distance T / determinant along the largest component.
  const auto determinant = hn::Add(hn::Add(e0, e1), e2);
  const auto size = hn::Abs(determinant);
  const auto numerator =
      hn::Mul(hn::CopySignToAbs(hn::Set(d, 1.0f), hn::Xor(determinant, hn::Set(d, c.toward))),
              hn::MulAdd(e2, z[2], hn::MulAdd(e1, z[1], hn::Mul(e0, z[0]))));
  const auto error = hn::MulAdd(
      size, hn::MulAdd(hn::Set(d, 5 * u), distance, hn::Set(d, is_moved ? c.origin_error : 0)),
      hn::MulAdd(hn::Mul(hn::Set(d, 6.5f), bound), distance, hn::Set(d, FLT_MIN)));
  const auto least = hn::Sub(numerator, error);
  const auto most = hn::Add(numerator, error);
  const float limit = t_far * c.largest_component;
  const auto size_error = hn::Mul(hn::Set(d, 3.25f), bound);
  const auto beyond = hn::Or(hn::Gt(least, hn::Mul(hn::Set(d, limit), hn::Add(size, size_error))),
                             hn::Lt(most, hn::Zero(d)));
  const uint32_t possible = crossed & ~bits_of(beyond);
  if constexpr (verdicts == Verdicts::possible) return {possible, 0};
  if constexpr (flow == Flow::leaves_early) {
    if (possible == 0) return {0, 0};
  }
  const auto inside = hn::Or(hn::Gt(low, bound), hn::Lt(high, negative));
  if constexpr (is_moved) return {possible, 0};  // depths are not known well enough
  const float start = (c.t_min * (1 + 8 * u) + FLT_MIN) * c.largest_component * (1 + 8 * u);
  const auto within =
      hn::And(hn::Gt(least, hn::Mul(hn::Set(d, start), hn::Add(size, size_error))),
              hn::Lt(most, hn::Mul(hn::Set(d, limit * (1 - 32 * u)), hn::Sub(size, size_error))));
  return {possible, possible & bits_of(hn::And(inside, within))};
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
