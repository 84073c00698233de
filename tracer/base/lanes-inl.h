// SPDX-License-Identifier: MIT
// Formulas written once for a double and for a vector of doubles: `Real` is either. The same
// operations in the same order give each lane the bits of the double.
#if defined(TRACER_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_LANES_INL_H
#undef TRACER_LANES_INL_H
#else
#define TRACER_LANES_INL_H
#endif

#include <cmath>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using LaneTag = hn::CappedTag<double, 8>;

struct LaneMask {
  hn::Mask<LaneTag> bits;

  friend HWY_INLINE LaneMask operator&(LaneMask a, LaneMask b) { return {hn::And(a.bits, b.bits)}; }
  friend HWY_INLINE LaneMask operator|(LaneMask a, LaneMask b) { return {hn::Or(a.bits, b.bits)}; }
  friend HWY_INLINE LaneMask operator!(LaneMask a) { return {hn::Not(a.bits)}; }
};

struct Lanes {
  hn::Vec<LaneTag> v;

  HWY_INLINE Lanes(double value) : v(hn::Set(LaneTag(), value)) {}
  HWY_INLINE explicit Lanes(hn::Vec<LaneTag> values) : v(values) {}
  /// `from` has room for a whole vector, and its address is a multiple of its size.
  static HWY_INLINE Lanes load(const double* from) { return Lanes(hn::Load(LaneTag(), from)); }
  static HWY_INLINE Lanes load(const float* from) {
    const hn::Rebind<float, LaneTag> floats;
    return Lanes(hn::PromoteTo(LaneTag(), hn::Load(floats, from)));
  }
  HWY_INLINE void store(double* to) const { hn::Store(v, LaneTag(), to); }
  /// Rounded to nearest.
  HWY_INLINE void store(float* to) const {
    const hn::Rebind<float, LaneTag> floats;
    hn::Store(hn::DemoteTo(floats, v), floats, to);
  }

  friend HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return Lanes(hn::Add(a.v, b.v)); }
  friend HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return Lanes(hn::Sub(a.v, b.v)); }
  friend HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return Lanes(hn::Mul(a.v, b.v)); }
  friend HWY_INLINE Lanes operator/(Lanes a, Lanes b) { return Lanes(hn::Div(a.v, b.v)); }
  friend HWY_INLINE Lanes operator-(Lanes a) { return Lanes(hn::Neg(a.v)); }
  friend HWY_INLINE LaneMask operator<(Lanes a, Lanes b) { return {hn::Lt(a.v, b.v)}; }
  friend HWY_INLINE LaneMask operator>(Lanes a, Lanes b) { return {hn::Gt(a.v, b.v)}; }
  friend HWY_INLINE LaneMask operator>=(Lanes a, Lanes b) { return {hn::Ge(a.v, b.v)}; }
  friend HWY_INLINE LaneMask operator==(Lanes a, Lanes b) { return {hn::Eq(a.v, b.v)}; }
};

HWY_INLINE Lanes select(LaneMask mask, Lanes yes, Lanes no) {
  return Lanes(hn::IfThenElse(mask.bits, yes.v, no.v));
}
HWY_INLINE double select(bool mask, double yes, double no) {
  return mask ? yes : no;
}
HWY_INLINE bool any(LaneMask mask) {
  return !hn::AllFalse(LaneTag(), mask.bits);
}
HWY_INLINE bool any(bool mask) {
  return mask;
}
HWY_INLINE Lanes sqrt(Lanes x) {
  return Lanes(hn::Sqrt(x.v));
}
HWY_INLINE double sqrt(double x) {
  return std::sqrt(x);
}
HWY_INLINE Lanes abs(Lanes x) {
  return Lanes(hn::Abs(x.v));
}
HWY_INLINE double abs(double x) {
  return std::abs(x);
}
HWY_INLINE Lanes copy_sign(Lanes magnitude, Lanes sign) {
  return Lanes(hn::CopySign(magnitude.v, sign.v));
}
HWY_INLINE double copy_sign(double magnitude, double sign) {
  return std::copysign(magnitude, sign);
}
template <class Real>
HWY_INLINE Real min(Real a, Real b) {
  return select(b < a, b, a);
}
template <class Real>
HWY_INLINE Real max(Real a, Real b) {
  return select(a < b, b, a);
}

/// A vector of three, by component.
template <class Real>
struct Vector3 {
  Real x, y, z;

  friend HWY_INLINE Vector3 operator+(const Vector3& a, const Vector3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend HWY_INLINE Vector3 operator-(const Vector3& a, const Vector3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend HWY_INLINE Vector3 operator-(const Vector3& a) { return {-a.x, -a.y, -a.z}; }
  friend HWY_INLINE Vector3 operator*(Real a, const Vector3& b) {
    return {a * b.x, a * b.y, a * b.z};
  }
};

template <class Real>
HWY_INLINE Real dot(const Vector3<Real>& a, const Vector3<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
HWY_INLINE Vector3<Real> cross(const Vector3<Real>& a, const Vector3<Real>& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
template <class Real>
HWY_INLINE Vector3<Real> abs(const Vector3<Real>& a) {
  return {abs(a.x), abs(a.y), abs(a.z)};
}
template <class Real>
HWY_INLINE Vector3<Real> max(const Vector3<Real>& a, const Vector3<Real>& b) {
  return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)};
}
template <class Mask, class Real>
HWY_INLINE Vector3<Real> select(Mask mask, const Vector3<Real>& yes, const Vector3<Real>& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
