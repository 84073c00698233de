// SPDX-License-Identifier: MIT
// Tests for all lanes of a block that leak less than Moeller and Trumbore's.
#if defined(BENCH_WATERTIGHT_BLOCK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BENCH_WATERTIGHT_BLOCK_INL_H
#undef BENCH_WATERTIGHT_BLOCK_INL_H
#else
#define BENCH_WATERTIGHT_BLOCK_INL_H
#endif

#include <cfloat>

#include <hwy/highway.h>

#include "tests/bench/compare/moeller_trumbore-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR

/// A hit at numerator / determinant, both of either sign.
struct MetFloats {
  Lanes numerator, determinant;
  hn::Mask<Floats> is_hit;
};

/// Of what the edge functions say, and t_min <= t <= t_far.
HWY_INLINE MetFloats within(hn::Mask<Floats> is_inside, Lanes numerator, Lanes determinant,
                            float t_min, float t_far) {
  const Floats d;
  const auto size = hn::Abs(determinant);
  const auto distance = hn::Xor(numerator, hn::And(determinant, hn::SignBit(d)));
  const auto is_within = hn::And(hn::Ge(distance, hn::Mul(hn::Set(d, t_min), size)),
                                 hn::Le(distance, hn::Mul(hn::Set(d, t_far), size)));
  const auto is_hit = hn::And(hn::And(is_inside, is_within), hn::Gt(size, hn::Zero(d)));
  return {numerator, determinant, is_hit};
}

/// a_x b_y - a_y b_x, of products that are rounded one as the other: an FMA would leak.
HWY_INLINE Lanes woop_edge(const Vectors<Lanes>& a, const Vectors<Lanes>& b) {
  return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x));
}

HWY_INLINE Lanes woop_edge_in_double(const Vectors<Lanes>& a, const Vectors<Lanes>& b) {
  const Floats d;
  constexpr size_t most = hn::MaxLanes(Floats());
  alignas(64) float ax[most], ay[most], bx[most], by[most], edge[most];
  hn::Store(a.x, d, ax);
  hn::Store(a.y, d, ay);
  hn::Store(b.x, d, bx);
  hn::Store(b.y, d, by);
  for (size_t i = 0; i < hn::Lanes(d); ++i) {
    edge[i] = static_cast<float>(double{ax[i]} * by[i] - double{ay[i]} * bx[i]);
  }
  return hn::Load(d, edge);
}

/// [Woop 2013] without culling; in double where an edge function is zero.
HWY_INLINE MetFloats meet_woop(const float* HWY_RESTRICT rows, const RayConstants& c, float t_far) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  Vectors<Lanes> v[3];
  for (size_t corner = 0; corner < 3; ++corner) {
    const float* row = rows + 3 * corner * width;
    const auto z = hn::Sub(hn::Load(d, row + c.leaf_row[2]), hn::Set(d, c.leaf_origin[2]));
    const auto x = hn::Sub(hn::Load(d, row + c.leaf_row[0]), hn::Set(d, c.leaf_origin[0]));
    const auto y = hn::Sub(hn::Load(d, row + c.leaf_row[1]), hn::Set(d, c.leaf_origin[1]));
    v[corner] = {hn::NegMulAdd(hn::Set(d, c.shear[0]), z, x),
                 hn::NegMulAdd(hn::Set(d, c.shear[1]), z, y), z};
  }
  auto e0 = woop_edge(v[2], v[1]);
  auto e1 = woop_edge(v[0], v[2]);
  auto e2 = woop_edge(v[1], v[0]);
  const auto zero = hn::Zero(d);
  const auto is_zero = hn::Or(hn::Or(hn::Eq(e0, zero), hn::Eq(e1, zero)), hn::Eq(e2, zero));
  if (HWY_UNLIKELY(!hn::AllFalse(d, is_zero))) {
    e0 = hn::IfThenElse(is_zero, woop_edge_in_double(v[2], v[1]), e0);
    e1 = hn::IfThenElse(is_zero, woop_edge_in_double(v[0], v[2]), e1);
    e2 = hn::IfThenElse(is_zero, woop_edge_in_double(v[1], v[0]), e2);
  }
  const auto low = hn::Min(hn::Min(e0, e1), e2);
  const auto high = hn::Max(hn::Max(e0, e1), e2);
  const auto numerator = hn::MulAdd(e2, v[2].z, hn::MulAdd(e1, v[1].z, hn::Mul(e0, v[0].z)));
  const auto determinant =
      hn::Mul(hn::Add(hn::Add(e0, e1), e2), hn::Set(d, c.toward * c.largest_component));
  return within(hn::Or(hn::Ge(low, zero), hn::Le(high, zero)), numerator, determinant, c.t_min,
                t_far);
}

/// Each component from the two edges whose products cancel less.
HWY_INLINE Vectors<Lanes> stable_normal(const Vectors<Lanes>& a, const Vectors<Lanes>& b,
                                        const Vectors<Lanes>& c) {
  const auto component = [](const Lanes& ay, const Lanes& az, const Lanes& by, const Lanes& bz,
                            const Lanes& cy, const Lanes& cz) {
    const auto ab = hn::Mul(az, by);
    const auto bc = hn::Mul(bz, cy);
    return hn::IfThenElse(hn::Lt(hn::Abs(ab), hn::Abs(bc)), hn::MulSub(ay, bz, ab),
                          hn::MulSub(by, cz, bc));
  };
  return {component(a.y, a.z, b.y, b.z, c.y, c.z), component(a.z, a.x, b.z, b.x, c.z, c.x),
          component(a.x, a.y, b.x, b.y, c.x, c.y)};
}

/// Pluecker lines [Shoemake 1998] as Embree's robust mode takes them: edges that neighbours compute
/// as exact opposites, and a tolerance relative to their sum.
HWY_INLINE MetFloats meet_pluecker(const float* HWY_RESTRICT rows, const Ray& ray, float t_min,
                                   float t_far) {
  const Floats d;
  const auto origin = spread(ray.origin);
  const auto direction = spread(ray.direction);
  const auto v0 = corners_of(rows, 0) - origin;
  const auto v1 = corners_of(rows, 1) - origin;
  const auto v2 = corners_of(rows, 2) - origin;
  const auto edge0 = v2 - v0;
  const auto edge1 = v0 - v1;
  const auto edge2 = v1 - v2;
  const auto side0 = dot(cross(edge0, v2 + v0), direction);
  const auto side1 = dot(cross(edge1, v0 + v1), direction);
  const auto side2 = dot(cross(edge2, v1 + v2), direction);
  const auto tolerance =
      hn::Mul(hn::Abs(hn::Add(hn::Add(side0, side1), side2)), hn::Set(d, FLT_EPSILON));
  const auto low = hn::Min(hn::Min(side0, side1), side2);
  const auto high = hn::Max(hn::Max(side0, side1), side2);
  const auto is_inside = hn::Or(hn::Ge(low, hn::Neg(tolerance)), hn::Le(high, tolerance));
  const auto normal = stable_normal(edge0, edge1, edge2);
  return within(is_inside, dot(v0, normal), dot(direction, normal), t_min, t_far);
}

/// [Moeller 1997] on the same floats in double, as many at a time as vectors hold.
HWY_INLINE void meet_in_double(const float* HWY_RESTRICT rows, uint32_t count, const Ray& ray,
                               uint32_t& hits, double* HWY_RESTRICT t) {
  const hn::CappedTag<double, 8> d;
  const hn::Rebind<float, decltype(d)> d_float;
  using Doubles = hn::Vec<decltype(d)>;
  const size_t width = hn::Lanes(Floats());
  const auto load = [&](const float* lanes) { return hn::PromoteTo(d, hn::LoadU(d_float, lanes)); };
  const auto spread_in_double = [&](const Vec3f& v) {
    return Vectors<Doubles>{hn::Set(d, double{v.x}), hn::Set(d, double{v.y}),
                            hn::Set(d, double{v.z})};
  };
  const auto origin = spread_in_double(ray.origin);
  const auto direction = spread_in_double(ray.direction);
  for (size_t first = 0; first < width; first += hn::Lanes(d)) {
    const auto corner = [&](size_t row) {
      const float* lanes = rows + row * width + first;
      return Vectors<Doubles>{load(lanes), load(lanes + width), load(lanes + 2 * width)};
    };
    const auto met = meet_moeller_trumbore(d, origin, direction, corner(0), corner(3), corner(6),
                                           hn::Set(d, ray.t_min), hn::Set(d, ray.t_max));
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, met.is_hit, bytes);
    uint32_t bits = bytes[0] & ((1u << hn::Lanes(d)) - 1);
    hits |= bits << first;
    if (HWY_LIKELY(bits == 0)) continue;
    alignas(64) double distances[hn::MaxLanes(d)];
    hn::Store(hn::Div(met.numerator, met.determinant), d, distances);
    for (; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(bits));
      t[first + lane] = distances[lane];
    }
  }
  hits &= (2u << (count - 1)) - 1;
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
