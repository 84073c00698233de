// SPDX-License-Identifier: MIT
// Where rays meet flat triangles, and where they leave them: for one ray or a vector of them.
#if defined(TRACER_FLAT_SURFACE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_FLAT_SURFACE_INL_H
#undef TRACER_FLAT_SURFACE_INL_H
#else
#define TRACER_FLAT_SURFACE_INL_H
#endif

#include "tracer/base/lanes-inl.h"
#include "tracer/scene/scene.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {

/// A mesh's triangle: coordinates that floats hold.
template <class Real>
struct Corners {
  Vector3<Real> v0, v1, v2;

  HWY_INLINE Vector3<Real> at(Real u, Real v) const {
    return (Real(1) - u - v) * v0 + u * v1 + v * v2;
  }
  /// Of twice the area's length, right-handed about v0 v1 v2.
  HWY_INLINE Vector3<Real> area_normal() const { return cross(v1 - v0, v2 - v0); }
};

HWY_INLINE Vector3<double> components(const Vec3d& v) {
  return {v.x, v.y, v.z};
}
HWY_INLINE Vec3d joined(const Vector3<double>& v) {
  return {v.x, v.y, v.z};
}
HWY_INLINE Corners<double> corners_of(const Triangle& triangle) {
  return {components(triangle.v0), components(triangle.v1), components(triangle.v2)};
}

/// v at unit length, or `fallback` where v is zero. The squares of its components and their sum
/// neither overflow nor vanish: differences of floats and products of two such are like that.
template <class Real>
HWY_INLINE Vector3<Real> unit_or(const Vector3<Real>& v, const Vector3<Real>& fallback) {
  const Real square = dot(v, v);
  return select(square > Real(0), (Real(1) / sqrt(square)) * v, fallback);
}

// With m the largest |coordinates| of the corners, n the normal and u = 2^-24, distances from the
// plane are at most
//   u n.m     for rounding the origin to float, which moves it by u |p_i| <= u m_i an axis;
//   4 u n.m   for a neighbour that was coplanar (a quad's other half) before its corners and ours
//             were rounded to float: u n.m for each of four corners;
//   2^-49 |m| for computing the position and the normal in double, some ten roundings, unless the
//             triangle's sides are within 2^-20 of parallel.
// 6 u n.m + 2^-46 |m| exceeds their sum. Where the plane passes exactly through an axis (n.m = 0)
// float coordinates hold the second term exactly enough: they are finest near 0.
/// How far along its unit normal a ray must leave a triangle to start strictly outside, even when
/// its origin is then rounded to float.
template <class Real>
HWY_INLINE Real clearance_of(const Corners<Real>& triangle, const Vector3<Real>& normal) {
  const Vector3<Real> largest = max(abs(triangle.v0), max(abs(triangle.v1), abs(triangle.v2)));
  return Real(6 * 0x1p-24) * dot(abs(normal), largest) +
         Real(0x1p-46) * (largest.x + largest.y + largest.z);
}

template <class Real>
struct FlatSurface {
  Vector3<Real> position;
  Vector3<Real> normal;  // unit length, towards the side that the ray came from
  Real clearance;        // of the triangle along the normal
};

/// A point of the triangle near `position`, at least `distance` from its edges where it is that
/// large. Rays that start there are not pushed through the neighbour across an edge.
template <class Real>
HWY_INLINE Vector3<Real> keep_off_edges(const Corners<Real>& triangle,
                                        const Vector3<Real>& area_normal, Real u, Real v,
                                        const Vector3<Real>& position, Real distance) {
  const Vector3<Real> a = triangle.v2 - triangle.v1;
  const Vector3<Real> b = triangle.v0 - triangle.v2;
  const Vector3<Real> c = triangle.v1 - triangle.v0;
  // The height over a side is twice the area / side.
  const Real scale = distance * distance / dot(area_normal, area_normal);
  const Vector3<Real> least_squares{scale * dot(a, a), scale * dot(b, b), scale * dot(c, c)};
  const Vector3<Real> weights{Real(1) - u - v, u, v};
  const auto is_near = [](Real weight, Real least_square) HWY_ATTR {
    return !((weight >= Real(0)) & (weight * weight >= min(least_square, Real(0.25 * 0.25))));
  };
  const auto near_a = is_near(weights.x, least_squares.x);
  const auto near_b = is_near(weights.y, least_squares.y);
  const auto near_c = is_near(weights.z, least_squares.z);
  const auto is_near_any = near_a | near_b | near_c;
  if (!any(is_near_any)) return position;
  const auto clear = [](auto near, Real weight, Real least_square) HWY_ATTR {
    return select(near, min(sqrt(least_square), Real(0.25)), weight);
  };
  const Vector3<Real> moved{clear(near_a, weights.x, least_squares.x),
                            clear(near_b, weights.y, least_squares.y),
                            clear(near_c, weights.z, least_squares.z)};
  const Real sum = moved.x + moved.y + moved.z;
  return select(is_near_any, triangle.at(moved.y / sum, moved.z / sum), position);
}

/// What a ray of `direction` meets at the weights u and v.
template <class Real>
HWY_INLINE FlatSurface<Real> flat_surface(const Corners<Real>& triangle, Real u, Real v,
                                          const Vector3<Real>& direction) {
  const Vector3<Real> area_normal = triangle.area_normal();
  const Vector3<Real> either = unit_or(area_normal, {Real(0), Real(0), Real(1)});
  const Vector3<Real> normal = select(dot(either, direction) > Real(0), -either, either);
  const Real clearance = clearance_of(triangle, normal);
  const Vector3<Real> position = triangle.at(u, v);
  // What rounding the origin may move the point sideways, for neighbours at angles of 15 degrees or
  // more.
  const Vector3<Real> size = abs(position);
  const Real rounding = Real(0x1p-24) * (size.x + size.y + size.z);
  return {keep_off_edges(triangle, area_normal, u, v, position, Real(4) * (clearance + rounding)),
          normal, clearance};
}

}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
