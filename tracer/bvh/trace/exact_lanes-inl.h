// SPDX-License-Identifier: MIT
// intersect_triangle in vectors of doubles, for as many rays at once as have room, or for one: the
// same operations in the same order, so the same bits.
#if defined(TRACER_EXACT_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_EXACT_LANES_INL_H
#undef TRACER_EXACT_LANES_INL_H
#else
#define TRACER_EXACT_LANES_INL_H
#endif

#include <algorithm>
#include <cmath>

#include <hwy/highway.h>

#include "tracer/base/vectors.h"
#include "tracer/geometry/ray.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

using tracer::max_abs;
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

// Not below intersect_triangle's, whatever the order of the bounds' products.
constexpr double lanes_weight_error = 37 * 0x1p-53;
constexpr double lanes_sign_error = 19 * 0x1p-53;
constexpr double lanes_quotient_error = 19 * 0x1p-53 / (0.9 * 0x1p-33);

struct TriangleHitLanes {
  DoubleLanes t, u, v;
  hn::Mask<Doubles> is_certain, is_hit;
};

/// Where `is_certain`, the ray hits the triangle if `is_hit` and t is in its range, and t, u, v are
/// those of intersect_triangle.
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

  const auto length1 = max_abs(edge1);
  const auto length2 = max_abs(edge2);
  const auto length = hn::Max(length1, length2);
  const auto speed = sum_abs(direction);
  const auto bound = hn::Mul(hn::Mul(hn::Set(d, lanes_weight_error), hn::Mul(speed, length)),
                             hn::Add(max_abs(to_v0), length));
  const auto least_weight = hn::Min(hn::Min(hn::Abs(weight0), hn::Abs(v)), hn::Abs(w));
  const auto area = hn::Mul(length1, length2);
  const auto reach = hn::Mul(area, sum_abs(to_v0));
  const auto size = hn::Abs(numerator);
  const auto zero = hn::Zero(d);
  const auto is_inside = hn::Or(hn::Gt(hn::Min(hn::Min(weight0, v), w), zero),
                                hn::Lt(hn::Max(hn::Max(weight0, v), w), zero));
  const auto is_behind = hn::And(hn::Lt(hn::Mul(numerator, sum), zero),
                                 hn::Gt(size, hn::Mul(reach, hn::Set(d, lanes_sign_error))));
  const auto is_hit = hn::AndNot(is_behind, is_inside);
  const auto is_quotient_certain =
      hn::And(hn::Gt(size, hn::Mul(reach, hn::Set(d, lanes_quotient_error))),
              hn::Gt(hn::Abs(determinant),
                     hn::Mul(hn::Mul(area, speed), hn::Set(d, lanes_quotient_error))));
  const auto is_certain =
      hn::And(hn::Gt(least_weight, bound), hn::Or(is_quotient_certain, hn::Not(is_hit)));
  const auto weight1 = hn::Div(v, sum);
  const auto weight2 = hn::Min(hn::Div(w, sum), hn::Sub(hn::Set(d, 1.0), weight1));
  return {hn::Div(numerator, determinant), weight1, weight2, is_certain, is_hit};
}

using FourDoubles = hn::CappedTag<double, 4>;
constexpr bool has_four_doubles = hn::MaxLanes(FourDoubles()) == 4;

struct CertainTriangleHit {
  double t, u, v;
  bool is_certain, is_hit;
};

/// As intersect_triangles, of one ray, with its vectors in the lanes: where `has_four_doubles`.
/// `rows`: of the corners' coordinates, `width` apart.
HWY_INLINE CertainTriangleHit intersect_certainly(const Ray& ray, const float* HWY_RESTRICT rows,
                                                  size_t width) {
  const FourDoubles d;
  const hn::Half<FourDoubles> half;
  const hn::Rebind<float, FourDoubles> df;
  // (edge2, direction, edge1, to_v0) = (v2, direction, v1, v0) - (v0, 0, v0, origin)
  const auto vectors_along = [&](int axis) {
    const auto corner = [&](int index) {
      return hn::Set(df, rows[static_cast<size_t>(3 * index + axis) * width]);
    };
    const auto v0 = corner(0);
    const auto direction = hn::Set(df, ray.direction[axis]);
    const auto origin = hn::Set(df, ray.origin[axis]);
    const auto to = hn::OddEven(hn::ConcatUpperLower(df, v0, direction),
                                hn::ConcatUpperLower(df, corner(1), corner(2)));
    const auto from = hn::OddEven(hn::ConcatUpperLower(df, origin, hn::Zero(df)), v0);
    return hn::Sub(hn::PromoteTo(d, to), hn::PromoteTo(d, from));
  };
  const auto x = vectors_along(0), y = vectors_along(1), z = vectors_along(2);

  // (normal, moment) = (edge2, direction) x (edge1, to_v0), laid out as (moment, normal) twice
  const auto ax = hn::LowerHalf(half, x), bx = hn::UpperHalf(half, x);
  const auto ay = hn::LowerHalf(half, y), by = hn::UpperHalf(half, y);
  const auto az = hn::LowerHalf(half, z), bz = hn::UpperHalf(half, z);
  const auto swapped_twice = [&](auto pair) {
    const auto swapped = hn::Reverse2(half, pair);
    return hn::Combine(d, swapped, swapped);
  };
  const auto cross_x = swapped_twice(hn::Sub(hn::Mul(ay, bz), hn::Mul(by, az)));
  const auto cross_y = swapped_twice(hn::Sub(hn::Mul(az, bx), hn::Mul(bz, ax)));
  const auto cross_z = swapped_twice(hn::Sub(hn::Mul(ax, by), hn::Mul(bx, ay)));

  alignas(32) double products[4];  // v, determinant, -w, numerator of t
  alignas(32) double greatest[4];
  alignas(32) double sums[4];
  const auto product_xy = hn::Add(hn::Mul(x, cross_x), hn::Mul(y, cross_y));
  hn::Store(hn::Add(product_xy, hn::Mul(z, cross_z)), d, products);
  const auto size_x = hn::Abs(x), size_y = hn::Abs(y), size_z = hn::Abs(z);
  hn::Store(hn::Max(hn::Max(size_x, size_y), size_z), d, greatest);
  hn::Store(hn::Add(hn::Add(size_x, size_y), size_z), d, sums);

  const double v = products[0];
  const double w = -products[2];
  const double determinant = products[1];
  const double numerator = products[3];
  const double weight0 = determinant - v - w;
  const double sum = weight0 + v + w;
  const double length = std::max(greatest[0], greatest[2]);
  const double speed = sums[1];
  const double bound = lanes_weight_error * (speed * length) * (greatest[3] + length);
  const double least_weight = std::min(std::min(std::abs(weight0), std::abs(v)), std::abs(w));
  const double area = greatest[0] * greatest[2];
  const double reach = area * sums[3];
  const double size = std::abs(numerator);
  const bool is_inside =
      std::min(std::min(weight0, v), w) > 0 || std::max(std::max(weight0, v), w) < 0;
  const bool is_behind = numerator * sum < 0 && size > reach * lanes_sign_error;
  const bool is_hit = is_inside && !is_behind;
  const bool is_quotient_certain = size > reach * lanes_quotient_error &&
                                   std::abs(determinant) > area * speed * lanes_quotient_error;
  const bool is_certain = least_weight > bound && (!is_hit || is_quotient_certain);
  const double weight1 = v / sum;
  return {numerator / determinant, weight1, std::min(w / sum, 1 - weight1), is_certain, is_hit};
}

/// Corners of triangles, one a lane.
struct CornerLanes {
  alignas(64) float rows[9][hn::MaxLanes(Doubles())];

  VectorLanes corner(size_t index) const {
    const Doubles d;
    const hn::Rebind<float, Doubles> df;
    const auto load = [&](size_t row) { return hn::PromoteTo(d, hn::Load(df, rows[row])); };
    return {load(3 * index), load(3 * index + 1), load(3 * index + 2)};
  }
  Vec3f vertex(size_t index, size_t lane) const {
    return {rows[3 * index][lane], rows[3 * index + 1][lane], rows[3 * index + 2][lane]};
  }
};

#endif
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
