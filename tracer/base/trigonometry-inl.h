// SPDX-License-Identifier: MIT
// Sines and cosines from +, - and * alone, for one angle or a vector of them.
#if defined(TRACER_TRIGONOMETRY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_TRIGONOMETRY_INL_H
#undef TRACER_TRIGONOMETRY_INL_H
#else
#define TRACER_TRIGONOMETRY_INL_H
#endif

#include <array>
#include <cstddef>
#include <numbers>

#include "tracer/base/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {

/// (-1)^i / (2 i + first)!: the series of sine and cosine, whose next term is below 1e-17 at pi/4.
template <int first>
constexpr std::array<double, 9> alternating_series() {
  std::array<double, 9> coefficients{};
  double factorial = 1;
  for (int i = 0; i < 9; ++i) {
    if (i > 0) factorial *= (2.0 * i + first) * (2.0 * i + first - 1);
    coefficients[static_cast<size_t>(i)] = (i % 2 == 0 ? 1 : -1) / factorial;
  }
  return coefficients;
}
inline constexpr std::array sin_coefficients = alternating_series<1>();
inline constexpr std::array cos_coefficients = alternating_series<0>();

/// Added and taken away, it rounds to a whole number.
inline constexpr double whole = 0x1.8p52;

template <class Real>
struct CosSinOf {
  Real cos, sin;
};

/// Of angles in [-pi/4, pi/4].
template <class Real>
HWY_INLINE CosSinOf<Real> cos_sin_series(Real angle) {
  const Real square = angle * angle;
  Real sin_series = sin_coefficients.back();
  Real cos_series = cos_coefficients.back();
  for (size_t i = sin_coefficients.size() - 1; i-- > 0;) {
    sin_series = Real(sin_coefficients[i]) + square * sin_series;
    cos_series = Real(cos_coefficients[i]) + square * cos_series;
  }
  return {cos_series, angle * sin_series};
}

/// Cosine and sine of pi/4 `eighths`, |eighths| <= 1, each within 1e-15.
template <class Real>
HWY_INLINE CosSinOf<Real> cos_sin_of_eighth_turns(Real eighths) {
  return cos_sin_series(eighths * Real(std::numbers::pi / 4));
}

/// Cosine and sine of 2 pi `turns`, |turns| < 2^50, each within 1e-15.
template <class Real>
HWY_INLINE CosSinOf<Real> cos_sin_of_turns(Real turns) {
  const Real quarters = (Real(4) * turns + Real(whole)) - Real(whole);
  // In [-pi/4, pi/4]; the subtraction is exact.
  const auto [cos_series, sin] =
      cos_sin_series((turns - Real(0.25) * quarters) * Real(2 * std::numbers::pi));
  // -2 to 2.
  const Real quadrant = quarters - Real(4) * ((Real(0.25) * quarters + Real(whole)) - Real(whole));
  const auto is_odd = abs(quadrant) == Real(1);
  const auto is_cos_negative = (quadrant == Real(1)) | (abs(quadrant) == Real(2));
  const auto is_sin_negative = (quadrant == Real(-1)) | (abs(quadrant) == Real(2));
  const Real cos = select(is_odd, sin, cos_series);
  const Real other = select(is_odd, cos_series, sin);
  return {select(is_cos_negative, -cos, cos), select(is_sin_negative, -other, other)};
}

}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
