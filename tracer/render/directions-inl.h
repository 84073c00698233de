// SPDX-License-Identifier: MIT
// Directions that scattered light takes, and points on lights: for one ray or a vector of them.
#if defined(TRACER_DIRECTIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_DIRECTIONS_INL_H
#undef TRACER_DIRECTIONS_INL_H
#else
#define TRACER_DIRECTIONS_INL_H
#endif

#include <numbers>

#include "tracer/base/trigonometry-inl.h"
#include "tracer/scene/flat_surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {

/// A point uniform in the unit disk, less than 1 from its centre; u uniform in [0, 1)^2, multiples
/// of 2^-24. Squares become pieces of rings little longer than wide [Shirley 1997].
template <class Real>
struct DiskPoint {
  Real x, y;
};
template <class Real>
HWY_INLINE DiskPoint<Real> disk_point(Real u_x, Real u_y) {
  // From the middle of each step.
  const Real a = Real(2) * u_x - Real(1 - 0x1p-24), b = Real(2) * u_y - Real(1 - 0x1p-24);
  const auto is_x_larger = abs(a) > abs(b);
  const Real larger = select(is_x_larger, a, b), smaller = select(is_x_larger, b, a);
  const CosSinOf<Real> around = cos_sin_of_eighth_turns(smaller / larger);
  const Real along = larger * around.cos, across = larger * around.sin;
  return {select(is_x_larger, along, across), select(is_x_larger, across, along)};
}

/// A unit vector about the unit vector `normal`, never below its plane; u uniform in [0, 1)^2. Its
/// pdf by solid angle is its cosine / pi. [Duff 2017] for the frame.
template <class Real>
HWY_INLINE Vector3<Real> cosine_hemisphere(const Vector3<Real>& normal, Real u_x, Real u_y) {
  const DiskPoint<Real> p = disk_point(u_x, u_y);
  const Real sign = copy_sign(Real(1), normal.z);
  const Real a = Real(-1) / (sign + normal.z);
  const Real b = normal.x * normal.y * a;
  const Vector3<Real> x{Real(1) + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
  const Vector3<Real> y{b, sign + normal.y * normal.y * a, -normal.y};
  return p.x * x + p.y * y + sqrt(Real(1) - (p.x * p.x + p.y * p.y)) * normal;
}

/// Weight of a sample with `pdf` where the same could have come with `other_pdf`, by the power
/// heuristic with exponent 2 [Veach 1995].
template <class Real>
HWY_INLINE Real power_heuristic(Real pdf, Real other_pdf) {
  const Real ratio = other_pdf / pdf;
  return Real(1) / (Real(1) + ratio * ratio);
}

/// Weights of a triangle's second and third corner, uniform by area; u uniform in [0, 1)^2. The
/// square is folded onto half of it, which distorts less than a root [Heitz 2019].
template <class Real>
struct TrianglePoint {
  Real u, v;
};
template <class Real>
HWY_INLINE TrianglePoint<Real> triangle_point(Real u_x, Real u_y) {
  const auto is_above = u_y > u_x;
  const Real half = Real(0.5) * select(is_above, u_x, u_y);
  const Real other = select(is_above, u_y, u_x) - half;
  return {select(is_above, half, other), select(is_above, other, half)};
}

/// A point uniform by area on a light, seen from a surface.
template <class Real>
struct LightPoint {
  Vector3<Real> direction;  // unit length
  Vector3<Real> end;        // of the shadow ray, clear of the light
  Real pdf;                 // by solid angle, of this triangle alone; 0: it turns its edge
};

/// u uniform in [0, 1)^2; the shadow ray starts at `origin`, which floats hold. It ends before the
/// light's plane even after its direction is rounded to float.
template <class Real>
HWY_INLINE LightPoint<Real> light_point(const Corners<Real>& light, Real u_x, Real u_y,
                                        const FlatSurface<Real>& surface,
                                        const Vector3<Real>& origin) {
  const TrianglePoint<Real> where = triangle_point(u_x, u_y);
  const Vector3<Real> point = light.at(where.u, where.v);
  const Vector3<Real> to_light = point - surface.position;
  const Real square = dot(to_light, to_light);
  const Vector3<Real> direction = unit_or(to_light, surface.normal);
  const Vector3<Real> area_normal = light.area_normal();
  const Vector3<Real> either = unit_or(area_normal, -direction);
  const Vector3<Real> normal = select(dot(either, direction) > Real(0), -either, either);
  const Real cosine = -dot(normal, direction);
  const Real area = Real(0.5) * sqrt(dot(area_normal, area_normal));
  const Real weight = cosine * area;
  const Vector3<Real> reach = abs(point - origin);
  const Real rounding = Real(2 * 0x1p-24) * dot(abs(normal), reach);
  return {direction, point + (clearance_of(light, normal) + rounding) * normal,
          select(weight > Real(0), square / weight, Real(0))};
}

}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
