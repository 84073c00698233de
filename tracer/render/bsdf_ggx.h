// SPDX-License-Identifier: MIT
// Microfacets distributed after GGX [Walter 2007], anisotropic. Directions are unit length, in the
// frame whose z axis is the normal.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tracer/base/trigonometry.h"
#include "tracer/base/vectors.h"

namespace tracer {

/// Slopes along x and y; both at least smoothest_alpha.
struct Ggx {
  double alpha_x = 1;
  double alpha_y = 1;

  /// Of isotropic facets that hold back about as much light.
  double mean_alpha() const { return std::min(1.0, (alpha_x + alpha_y) / 2); }

  /// Of normals, by solid angle: times h.z, it integrates to 1.
  double density(const Vec3d& h) const {
    const double x = h.x / alpha_x;
    const double y = h.y / alpha_y;
    const double sum = x * x + y * y + h.z * h.z;
    return 1 / (std::numbers::pi * alpha_x * alpha_y * sum * sum);
  }

  /// Hidden over visible area of facets, seen along w [Heitz 2014].
  double lambda(const Vec3d& w) const {
    const double x = alpha_x * w.x;
    const double y = alpha_y * w.y;
    return (std::sqrt(1 + (x * x + y * y) / (w.z * w.z)) - 1) / 2;
  }

  /// Pdf of sample() by solid angle of h; w.z > 0, h.z > 0.
  double visible_pdf(const Vec3d& w, const Vec3d& h) const {
    const double cosine = glm::dot(w, h);
    return cosine > 0 ? density(h) * cosine / (w.z * (1 + lambda(w))) : 0;
  }

  /// A normal of a facet as they are seen along w, w.z > 0; u uniform in [0, 1)^2 [Dupuy 2023].
  Vec3d sample(const Vec3d& w, const Vec2d& u) const {
    const Vec3d stretched = glm::normalize(Vec3d(alpha_x * w.x, alpha_y * w.y, w.z));
    const CosSin around = cos_sin_of_turns(u.x);
    const double z = (1 - u.y) * (1 + stretched.z) - stretched.z;
    const double radius = std::sqrt(std::max(0.0, 1 - z * z));
    const Vec3d h = Vec3d(radius * around.cos, radius * around.sin, z) + stretched;
    return glm::normalize(Vec3d(alpha_x * h.x, alpha_y * h.y, std::max(h.z, 0x1p-40)));
  }
};

/// Below this, a surface is a perfect mirror or window.
inline constexpr double smoothest_alpha = 0x1p-14;

/// Alpha is the square of roughness, stretched by anisotropy at equal area [Burley 2012].
inline Ggx make_ggx(double roughness, double anisotropy) {
  const double alpha = roughness * roughness;
  const double aspect = std::sqrt(1 - 0.9 * anisotropy);
  return {std::max(smoothest_alpha, alpha / aspect), std::max(smoothest_alpha, alpha * aspect)};
}

inline bool is_smooth(double roughness) {
  return roughness * roughness < smoothest_alpha;
}

/// (1 - cosine)^5, the shape of Fresnel's reflectance [Schlick 1994].
inline double schlick_weight(double cosine) {
  const double rest = std::max(0.0, 1 - cosine);
  const double square = rest * rest;
  return square * square * rest;
}

inline Vec3d mirrored(const Vec3d& w, const Vec3d& h) {
  return 2 * glm::dot(w, h) * h - w;
}

}  // namespace tracer
