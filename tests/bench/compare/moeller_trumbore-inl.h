// SPDX-License-Identifier: MIT
// The test that most ray tracers take, for all lanes of a block: float arithmetic, no bound, no
// second opinion. What exactness is measured against.
#if defined(BENCH_MOELLER_TRUMBORE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BENCH_MOELLER_TRUMBORE_INL_H
#undef BENCH_MOELLER_TRUMBORE_INL_H
#else
#define BENCH_MOELLER_TRUMBORE_INL_H
#endif

#include <hwy/highway.h>

#include "tracer/bvh/trace/wide_traverse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR

template <class V>
struct Vectors {
  V x, y, z;

  friend HWY_INLINE Vectors operator-(const Vectors& a, const Vectors& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
  }
  friend HWY_INLINE Vectors operator+(const Vectors& a, const Vectors& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
  }
};

template <class V>
HWY_INLINE V dot(const Vectors<V>& a, const Vectors<V>& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

template <class V>
HWY_INLINE Vectors<V> cross(const Vectors<V>& a, const Vectors<V>& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}

/// Weights of v1 and v2 and the distance, all times the determinant, which is not negative.
template <class V, class M>
struct MetTriangles {
  V determinant, weight1, weight2, numerator;
  M is_hit;
};

/// [Moeller 1997] for triangles of any orientation, and any determinant but 0. Distances from
/// t_min to t_far count.
template <class D, class V>
HWY_INLINE auto meet_moeller_trumbore(D d, const Vectors<V>& origin, const Vectors<V>& direction,
                                      const Vectors<V>& v0, const Vectors<V>& v1,
                                      const Vectors<V>& v2, V t_min, V t_far) {
  const auto edge1 = v1 - v0;
  const auto edge2 = v2 - v0;
  const auto p = cross(direction, edge2);
  const auto signed_determinant = dot(edge1, p);
  const auto sign = hn::And(signed_determinant, hn::SignBit(d));
  const auto determinant = hn::Abs(signed_determinant);
  const auto from_v0 = origin - v0;
  const auto weight1 = hn::Xor(dot(from_v0, p), sign);
  const auto q = cross(from_v0, edge1);
  const auto weight2 = hn::Xor(dot(direction, q), sign);
  const auto numerator = hn::Xor(dot(edge2, q), sign);
  const auto zero = hn::Zero(d);
  const auto is_inside = hn::And(hn::And(hn::Ge(weight1, zero), hn::Ge(weight2, zero)),
                                 hn::Le(hn::Add(weight1, weight2), determinant));
  const auto is_within = hn::And(hn::Ge(numerator, hn::Mul(t_min, determinant)),
                                 hn::Le(numerator, hn::Mul(t_far, determinant)));
  const auto is_hit = hn::And(hn::And(is_inside, is_within), hn::Gt(determinant, zero));
  return MetTriangles<V, decltype(is_hit)>{determinant, weight1, weight2, numerator, is_hit};
}

HWY_INLINE Vectors<Lanes> spread(const Vec3f& v) {
  const Floats d;
  return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}

/// Corner 0, 1 or 2 of a block's triangles.
HWY_INLINE Vectors<Lanes> corners_of(const float* HWY_RESTRICT rows, size_t corner) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  rows += 3 * corner * width;
  return {hn::Load(d, rows), hn::Load(d, rows + width), hn::Load(d, rows + 2 * width)};
}

/// The hits of a block, as float arithmetic takes them.
HWY_INLINE auto meet_block(const float* HWY_RESTRICT rows, const RayConstants& c, const Ray& ray,
                           float t_far) {
  const Floats d;
  return meet_moeller_trumbore(d, spread(ray.origin), spread(ray.direction), corners_of(rows, 0),
                               corners_of(rows, 1), corners_of(rows, 2),
                               hn::Set(d, static_cast<float>(ray.t_min)),
                               hn::Set(d, t_far + static_cast<float>(c.t_offset)));
}

HWY_INLINE uint32_t filled_lanes(const WideTree::BlockInfo& info) {
  return (2u << (info.count - 1)) - 1;
}

/// A leaf for the production traversal: a hit is what float arithmetic takes for one, t a float.
struct MoellerTrumboreLeaf {
  struct Found {
    uint32_t possible;
    alignas(64) float determinant[hn::MaxLanes(Floats())];
    alignas(64) float weight1[hn::MaxLanes(Floats())];
    alignas(64) float weight2[hn::MaxLanes(Floats())];
    alignas(64) float numerator[hn::MaxLanes(Floats())];
  };

  template <Query query, Slabs slabs, Flow flow>
  static HWY_INLINE Found find(const float* HWY_RESTRICT rows, const WideTree::BlockInfo& info,
                               const RayConstants& c, const Ray& ray, float,
                               const HitRange& range) {
    const Floats d;
    const auto met = meet_block(rows, c, ray, range.t_far);
    Found found;
    found.possible = bits_of(met.is_hit) & filled_lanes(info);
    if constexpr (flow == Flow::leaves_early) {
      if (HWY_LIKELY(found.possible == 0)) return found;
    }
    hn::Store(met.determinant, d, found.determinant);
    hn::Store(met.weight1, d, found.weight1);
    hn::Store(met.weight2, d, found.weight2);
    hn::Store(met.numerator, d, found.numerator);
    return found;
  }

  static HWY_INLINE Hit hit(const float* HWY_RESTRICT rows, const Found& found, int lane,
                            const Ray&) {
    const float inverse = 1 / found.determinant[lane];
    return {found.numerator[lane] * inverse, found.weight1[lane] * inverse,
            found.weight2[lane] * inverse,
            std::bit_cast<uint32_t>(rows[9 * hn::Lanes(Floats()) + static_cast<size_t>(lane)])};
  }
  static constexpr size_t tests_together = 1;
  template <Query>
  static HWY_INLINE void hits(std::span<const Candidate<Found>> candidates, Hit* hits) {
    const Candidate<Found>& only = candidates.front();
    *hits = hit(only.rows, *only.found, only.lane, *only.ray);
  }
};

/// The same where any hit will do: nothing is divided or kept.
struct AnyMoellerTrumboreLeaf {
  using Found = FilteredHits;

  template <Query query, Slabs slabs, Flow flow>
  static HWY_INLINE Found find(const float* HWY_RESTRICT rows, const WideTree::BlockInfo& info,
                               const RayConstants& c, const Ray& ray, float,
                               const HitRange& range) {
    const uint32_t hits =
        bits_of(meet_block(rows, c, ray, range.t_far).is_hit) & filled_lanes(info);
    return {hits, hits};
  }
  static HWY_INLINE Hit hit(const float* HWY_RESTRICT, const Found&, int, const Ray&) {
    return {.t = 0, .primitive = 0};
  }
  static constexpr size_t tests_together = 1;
  template <Query>
  static HWY_INLINE void hits(std::span<const Candidate<Found>> candidates, Hit* hits) {
    const Candidate<Found>& only = candidates.front();
    *hits = hit(only.rows, *only.found, only.lane, *only.ray);
  }
};

#endif
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
