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

/// A unit vector about the unit vector `normal`, never below its plane; u uniform in [0, 1)^2. Its
/// pdf by solid angle is its cosine / pi. [Duff 2017] for the frame.
template <class Real>
HWY_INLINE Vector3<Real> cosine_hemisphere(const Vector3<Real>& normal, Real u_x, Real u_y) {
  const Real radius = sqrt(u_x);
  const CosSinOf<Real> around = cos_sin_of_turns(u_y);
  const Real sign = copy_sign(Real(1), normal.z);
  const Real a = Real(-1) / (sign + normal.z);
  const Real b = normal.x * normal.y * a;
  const Vector3<Real> x{Real(1) + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
  const Vector3<Real> y{b, sign + normal.y * normal.y * a, -normal.y};
  return (radius * around.cos) * x + (radius * around.sin) * y + sqrt(Real(1) - u_x) * normal;
}

/// Weight of a sample with `pdf` where the same could have come with `other_pdf`, by the power
/// heuristic with exponent 2 [Veach 1995].
template <class Real>
HWY_INLINE Real power_heuristic(Real pdf, Real other_pdf) {
  const Real ratio = other_pdf / pdf;
  return Real(1) / (Real(1) + ratio * ratio);
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
  const Real root = sqrt(u_x);
  const Vector3<Real> point = light.at(root * (Real(1) - u_y), root * u_y);
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
