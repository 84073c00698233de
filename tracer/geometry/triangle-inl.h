// SPDX-License-Identifier: MIT
// intersect_triangle, for kernels that compile it for their instruction set: the same operations
// in the same order, so the same bits. The signs of three edge functions decide; docs/numerics.md
// derives the bounds. Floats are multiples of 2^-149 below 2^128, so every product here is 0 or of
// magnitude 2^-447 to 2^393: doubles never overflow nor underflow.
#pragma once

#include <algorithm>
#include <cmath>

#include "tracer/geometry/triangle.h"

namespace tracer {
namespace exact_triangle {

// Above the exact 14, 34, 16 and 14 by enough to cover the rounding of the bounds themselves.
inline constexpr double v_w_error = 16 * 0x1p-53;
inline constexpr double u_error = 36 * 0x1p-53;
inline constexpr double numerator_error = 18 * 0x1p-53;
inline constexpr double determinant_error = 16 * 0x1p-53;
// Two such relative errors and a rounded division stay within 2^-32.
inline constexpr double quotient_part_error = 0.9 * 0x1p-33;

// Barycentric weights of v0, v1, v2, times the determinant; not all zero, and no two of
// different sign, where the line meets the triangle.
struct Weights {
  double u, v, w;

  bool has_opposite_signs() const { return (u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0); }
  double sum() const { return u + v + w; }
};

struct Quotient {
  double numerator, denominator;
};

inline double sum_abs(const Vec3d& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// By expansions, where double precision cannot tell.
Weights exact_weights(const Ray& ray, const Vec3f& v0, const Vec3f& v1, const Vec3f& v2);
Quotient exact_distance(const Ray& ray, const Vec3f& v0, const Vec3f& v1, const Vec3f& v2);

[[gnu::always_inline]] inline std::optional<TriangleHit> intersect(const Ray& ray, const Vec3f& v0,
                                                                   const Vec3f& v1,
                                                                   const Vec3f& v2) noexcept {
  const Vec3d direction(ray.direction);
  const Vec3d to_v0 = Vec3d(v0) - Vec3d(ray.origin);
  const Vec3d edge1 = Vec3d(v1) - Vec3d(v0);
  const Vec3d edge2 = Vec3d(v2) - Vec3d(v0);
  const Vec3d moment = glm::cross(direction, to_v0);
  const double v = glm::dot(edge2, moment);
  const double w = -glm::dot(edge1, moment);

  const double distance = max_abs(to_v0);
  const double length1 = max_abs(edge1);
  const double length2 = max_abs(edge2);
  const double length = std::max(length1, length2);
  const double speed = sum_abs(direction);
  const double v_w_bound = v_w_error * speed * length * distance;
  if (std::min(v, w) < -v_w_bound && std::max(v, w) > v_w_bound) return std::nullopt;

  const Vec3d normal = glm::cross(edge2, edge1);
  const double determinant = glm::dot(direction, normal);
  Weights weights{determinant - v - w, v, w};
  const double u_bound = u_error * speed * length * (distance + length);
  // Not "<=": NaN, where a vertex or the direction is not finite, must not be certain.
  const bool certain =
      std::abs(weights.u) > u_bound && std::abs(v) > v_w_bound && std::abs(w) > v_w_bound;
  if (!certain) {
    if (!is_finite(direction) || !is_finite(to_v0) || !is_finite(edge1) || !is_finite(edge2)) {
      return std::nullopt;
    }
    weights = exact_weights(ray, v0, v1, v2);
  }
  if (weights.has_opposite_signs() || weights.sum() == 0) return std::nullopt;

  Quotient quotient{glm::dot(to_v0, normal), determinant};
  const double normal_bound = length1 * length2;
  const double numerator_bound = numerator_error * sum_abs(to_v0) * normal_bound;
  // A triangle behind the origin, however near: where rays leave a surface, mostly this one.
  if (quotient.numerator * weights.sum() < 0 && std::abs(quotient.numerator) > numerator_bound) {
    return std::nullopt;
  }
  const bool is_grazing = determinant_error * speed * normal_bound >
                          quotient_part_error * std::abs(quotient.denominator);
  if (is_grazing || numerator_bound > quotient_part_error * std::abs(quotient.numerator)) {
    quotient = exact_distance(ray, v0, v1, v2);
  }
  // The smaller the determinant, the more the errors of the weights count.
  if (is_grazing && certain) weights = exact_weights(ray, v0, v1, v2);
  const double t = quotient.numerator / quotient.denominator;
  if (!(t >= ray.t_min && t <= ray.t_max)) return std::nullopt;
  const double weight1 = weights.v / weights.sum();
  return TriangleHit{t, weight1, std::min(weights.w / weights.sum(), 1 - weight1)};
}

}  // namespace exact_triangle
}  // namespace tracer
