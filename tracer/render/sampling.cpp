// SPDX-License-Identifier: MIT
#include "tracer/render/sampling.h"

#include "tracer/render/directions-inl.h"

namespace tracer {

Vec3d sample_cosine_hemisphere(const Vec3d& normal, const Vec2d& u) {
  const auto [x, y, z] =
      HWY_NAMESPACE::cosine_hemisphere<double>({normal.x, normal.y, normal.z}, u.x, u.y);
  return {x, y, z};
}

Vec2d sample_triangle(const Vec2d& u) {
  const auto [second, third] = HWY_NAMESPACE::triangle_point(u.x, u.y);
  return {second, third};
}

double power_heuristic(double pdf, double other_pdf) {
  return HWY_NAMESPACE::power_heuristic(pdf, other_pdf);
}

}  // namespace tracer
