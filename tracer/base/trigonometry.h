// SPDX-License-Identifier: MIT
// Sines, cosines and angles from +, *, / and sqrt alone: the same bits with every C library.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace tracer {

struct CosSin {
  double cos = 1;
  double sin = 0;
};

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

/// Cosine and sine of 2 pi `turns`, |turns| < 2^50, each within 1e-15. Exact at whole quarters.
inline CosSin cos_sin_of_turns(double turns) {
  // Added and taken away, it rounds to a whole number.
  constexpr double rounder = 0x1.8p52;
  const double quarters = (4 * turns + rounder) - rounder;
  // In [-pi/4, pi/4]; the subtraction is exact.
  const double angle = (turns - 0.25 * quarters) * (2 * std::numbers::pi);
  const double square = angle * angle;
  double sin_series = sin_coefficients.back();
  double cos_series = cos_coefficients.back();
  for (size_t i = sin_coefficients.size() - 1; i-- > 0;) {
    sin_series = sin_coefficients[i] + square * sin_series;
    cos_series = cos_coefficients[i] + square * cos_series;
  }
  const double sin = angle * sin_series;
  const double cos = cos_series;
  const auto quadrant = static_cast<uint64_t>(static_cast<int64_t>(quarters));
  const CosSin turned = (quadrant & 1) == 0 ? CosSin{cos, sin} : CosSin{-sin, cos};
  return (quadrant & 2) == 0 ? turned : CosSin{-turned.cos, -turned.sin};
}

/// Tangent of half of an angle in degrees, 0 <= angle < 180.
inline double tan_half_degrees(double degrees) {
  const CosSin half = cos_sin_of_turns(degrees / 720);
  return half.sin / half.cos;
}

/// The angle of the vector (x, y), y >= 0, from the x axis, in [0, pi] radians, within 1e-15; 0 for
/// (0, 0).
inline double angle_of(double x, double y) {
  if (x < 0) return std::numbers::pi / 2 + angle_of(y, -x);
  if (y == 0) return 0;
  // Adding its length to x halves the vector's angle, here to pi / 16 at most.
  for (int halving = 0; halving < 3; ++halving) x += std::sqrt(x * x + y * y);
  const double tangent = y / x;
  const double square = tangent * tangent;
  double series = 1.0 / 23;
  for (int power = 21; power >= 1; power -= 2) series = 1.0 / power - square * series;
  return 8 * tangent * series;
}

}  // namespace tracer
