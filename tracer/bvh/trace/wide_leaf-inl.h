// SPDX-License-Identifier: MIT
// A float filter with a proved bound for a block of triangles: which of them a ray may hit, and,
// where any hit will do, which it hits certainly. docs/numerics.md derives the bound.
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

/// Lanes of a block: `certain` ones are among the `possible`, and none unless Query::occluded.
struct FilteredHits {
  uint32_t possible, certain;
};

/// What the ray may hit: by the sheared edge functions [Woop 2013] of the float-rounded vertices,
/// with `bound` at least their error.
template <Query query, Slabs slabs, Flow flow>
HWY_INLINE FilteredHits filter_hits(const float* HWY_RESTRICT block,
                                    const WideTree::BlockInfo& info, const RayConstants& c,
                                    float entry, const HitRange& range) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  // Both hold for every vertex of a leaf whose padded box the ray meets at `entry`. The same in all
  // lanes: they are wanted there, and from fused steps.
  constexpr bool is_moved = slabs == Slabs::moved;
  const auto reach = hn::Add(hn::Set(d, info.extent), hn::Set(d, c.slack));
  const auto extent = slabs == Slabs::fused
                          ? reach
                          : hn::MulAdd(hn::Set(d, entry), hn::Set(d, 33 * u * c.largest_component),
                                       hn::Mul(reach, hn::Set(d, 1 + 64 * u)));
  const auto distance = hn::MulAdd(hn::Set(d, entry), hn::Set(d, c.largest_component), extent);
  // 17/16 (8 e v + 64 u e e + 2 v v), e the extent and v = 10 u `from` a vertex's error, e <= from.
  const auto from =
      is_moved ? hn::Add(distance, hn::Set(d, c.origin_error * (0.2f / u))) : distance;
  const auto bound = hn::MulAdd(
      from, hn::MulAdd(from, hn::Set(d, 213 * u * u), hn::Mul(extent, hn::Set(d, 153 * u))),
      hn::Set(d, FLT_MIN));  // products below it round absolutely

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
      hn::Xor(hn::MulAdd(e2, z[2], hn::MulAdd(e1, z[1], hn::Mul(e0, z[0]))),
              hn::And(hn::Xor(determinant, hn::Set(d, c.toward)), hn::SignBit(d)));
  const auto depth_error = hn::MulAdd(size, hn::Set(d, 5 * u), hn::Mul(bound, hn::Set(d, 6.5f)));
  const auto error =
      hn::MulAdd(distance, depth_error,
                 is_moved ? hn::MulAdd(size, hn::Set(d, c.origin_error), hn::Set(d, FLT_MIN))
                          : hn::Set(d, FLT_MIN));
  const auto least = hn::Sub(numerator, error);
  const auto most = hn::Add(numerator, error);
  const float limit = range.t_far * c.largest_component;
  const auto size_most = hn::MulAdd(bound, hn::Set(d, 3.25f), size);
  const auto beyond =
      hn::Or(hn::Gt(least, hn::Mul(hn::Set(d, limit), size_most)), hn::Lt(most, hn::Zero(d)));
  const uint32_t possible = crossed & ~bits_of(beyond);
  // Rays with a moved origin are few.
  if constexpr (query == Query::closest_hit || is_moved) return {possible, 0};

  const auto is_inside = hn::Gt(hn::Max(low, hn::Neg(high)), bound);
  const auto size_least = hn::NegMulAdd(bound, hn::Set(d, 3.25f), size);
  const auto counts = hn::And(hn::Gt(least, hn::Zero(d)),
                              hn::Lt(most, hn::Mul(hn::Set(d, range.certain_end), size_least)));
  return {possible, possible & bits_of(hn::And(is_inside, counts))};
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
