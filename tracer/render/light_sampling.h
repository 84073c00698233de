// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/render/sampler.h"
#include "tracer/scene/scene.h"

namespace tracer {

/// A point on a light, as seen from a surface.
struct LightSample {
  Ray shadow_ray;         // to the point, t_max = 1; both ends clear of their triangles
  Vec3d direction{};      // unit length
  Vec3d radiance{};       // towards the surface
  double pdf = 0;         // by solid angle at the surface; 0: the light turns its edge
  uint32_t triangle = 0;  // that emits
};

/// A light picked by power.
struct LightPick {
  uint32_t triangle;
  double probability;
};
LightPick pick_light(const EmissiveTriangles& lights, double u);

/// Picks a triangle by power and a point on it by area. scene.lights is not empty.
LightSample sample_light(const Scene& scene, const Surface& surface, Sampler& sampler);

/// The pdf by solid angle with which sample_light, called where `ray` starts, finds the point of
/// `triangle` at distance ray.direction * t; 0 for triangles that are not among the lights.
double pdf_light(const Scene& scene, uint32_t triangle, const Ray& ray, double t);

}  // namespace tracer
