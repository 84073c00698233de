// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>

#include "tracer/base/vectors.h"

namespace tracer {

/// A unit vector about the unit vector `normal`, never below its plane; u uniform in [0, 1)^2. Its
/// pdf by solid angle is pdf_cosine_hemisphere.
Vec3d sample_cosine_hemisphere(const Vec3d& normal, const Vec2d& u);
inline double pdf_cosine_hemisphere(double cosine) {
  return cosine > 0 ? cosine / std::numbers::pi : 0;
}

/// Weights of a triangle's second and third vertex, uniform by area: pdf 1 / area. u uniform in
/// [0, 1)^2.
inline Vec2d sample_triangle(const Vec2d& u) {
  const double root = std::sqrt(u.x);
  return {root * (1 - u.y), root * u.y};
}

/// Weight of a sample with `pdf` where the same could have come with `other_pdf`, by the power
/// heuristic with exponent 2 [Veach 1995].
double power_heuristic(double pdf, double other_pdf);

}  // namespace tracer
