// SPDX-License-Identifier: MIT
// Surfaces that let a share of rays pass, as if they were not there.
#pragma once

#include <cmath>
#include <limits>

#include "tracer/bvh/trace/accel.h"
#include "tracer/render/sampler.h"
#include "tracer/scene/scene.h"

namespace tracer {

/// Beyond so many surfaces on its way a ray is met.
inline constexpr int most_passed_surfaces = 256;

/// The ray behind a hit. Its origin stays, and so do distances along it.
inline Ray behind(Ray ray, const Hit& hit) {
  ray.t_min = std::nextafter(hit.t, std::numeric_limits<double>::infinity());
  return ray;
}

/// What the ray meets: by chance `hit`, what it meets first, or something behind that. `ray` then
/// begins behind what it has passed.
inline Hit pass_through(const Scene& scene, RayCaster& rays, Sampler& sampler, Ray& ray, Hit hit) {
  for (int passed = 0; passed < most_passed_surfaces && hit.is_hit(); ++passed) {
    const double opacity = opacity_at(scene, hit);
    if (opacity >= 1 || sampler.next() < opacity) break;
    ray = behind(ray, hit);
    hit = rays.closest_hit(ray);
  }
  return hit;
}

/// The share of light that comes along the whole ray.
inline double transmittance(const Scene& scene, RayCaster& rays, Ray ray) {
  double share = 1;
  for (int passed = 0; passed < most_passed_surfaces; ++passed) {
    const Hit hit = rays.closest_hit(ray);
    if (!hit.is_hit()) return share;
    share *= 1 - opacity_at(scene, hit);
    if (!(share > 0)) return 0;
    ray = behind(ray, hit);
  }
  return 0;
}

/// The same of a ray that meets something; nobody looks where no surface lets rays pass.
inline double transmittance_past_hit(const Scene& scene, RayCaster& rays, const Ray& ray) {
  return scene.surfaces.has_alpha ? transmittance(scene, rays, ray) : 0;
}

}  // namespace tracer
