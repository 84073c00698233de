// SPDX-License-Identifier: MIT
// Sines, cosines and angles from +, *, / and sqrt alone: the same bits with every C library.
#pragma once

#include <cmath>
#include <numbers>

namespace tracer {

struct CosSin {
  double cos = 1;
  double sin = 0;
};

/// Cosine and sine of 2 pi `turns`, |turns| < 2^50, each within 1e-15. Exact at whole quarters.
CosSin cos_sin_of_turns(double turns);

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
