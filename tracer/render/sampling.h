// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
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
Vec2d sample_triangle(const Vec2d& u);

/// Weight of a sample with `pdf` where the same could have come with `other_pdf`, by the power
/// heuristic with exponent 2 [Veach 1995].
double power_heuristic(double pdf, double other_pdf);

/// From so many scatterings on paths end at random (Russian roulette): docs/error.md compares
/// others.
inline constexpr int first_roulette = 6;
/// Probability with which a path of that throughput then goes on.
inline double survival_probability(const Vec3d& throughput) {
  return std::min(1.0, std::max({throughput.x, throughput.y, throughput.z}));
}

}  // namespace tracer
