// SPDX-License-Identifier: MIT
// Integrators that show shape within a sample or two.
#pragma once

#include <optional>

#include "tracer/render/integrator.h"
#include "tracer/render/recorder.h"
#include "tracer/render/sampling.h"

namespace tracer {

/// Where the camera ray ends; nullopt, with `miss` recorded as the sky, where it meets nothing.
template <class Recorder>
std::optional<Surface> first_surface(const World& world, const CameraHit& camera, const Vec3d& miss,
                                     Recorder& recorder) {
  const auto& [ray, hit] = camera;
  recorder.camera(ray);
  if (hit.is_hit()) return surface_at(*world.scene, hit, Vec3d(ray.direction));
  recorder.sky(ray, Vec3d(1), miss);
  return std::nullopt;
}

/// Albedo times the cosine between view and shading normal, as if lit by a lamp on the camera,
/// plus emission; the sky where nothing is hit.
struct EyeLight {
  template <class Recorder>
  static Vec3d radiance(const World& world, RayCaster&, const CameraHit& camera, Sampler&,
                        const RenderSettings&, Recorder& recorder) {
    const auto first = first_surface(world, camera, world.sky, recorder);
    if (!first) return world.sky;
    const auto& [ray, hit] = camera;
    const Surface& surface = *first;
    const Vec3d view = unit_or(Vec3d(ray.direction), Vec3d(0));
    const double cosine = std::abs(glm::dot(surface.shading_normal, view));
    const Vec3d radiance = surface.albedo * cosine + surface.emission;
    recorder.hit(ray, hit, surface, Vec3d(1), radiance);
    return radiance;
  }
};

/// The world-space shading normal towards the viewer, (n + 1) / 2 as RGB; black where nothing is
/// hit, which no normal's colour is.
struct Normals {
  template <class Recorder>
  static Vec3d radiance(const World& world, RayCaster&, const CameraHit& camera, Sampler&,
                        const RenderSettings&, Recorder& recorder) {
    const auto first = first_surface(world, camera, Vec3d(0), recorder);
    if (!first) return Vec3d(0);
    const auto& [ray, hit] = camera;
    const Surface& surface = *first;
    const Vec3d radiance = 0.5 * (surface.shading_normal + Vec3d(1));
    recorder.hit(ray, hit, surface, Vec3d(1), radiance);
    return radiance;
  }
};

/// The part of cosine-weighted directions in which nothing lies within the diagonal of the bounds,
/// one direction a sample; white where nothing is hit: nothing is near.
struct AmbientOcclusion {
  template <class Recorder>
  static Vec3d radiance(const World& world, RayCaster& rays, const CameraHit& camera,
                        Sampler& sampler, const RenderSettings&, Recorder& recorder) {
    const auto first = first_surface(world, camera, Vec3d(1), recorder);
    if (!first) return Vec3d(1);
    const auto& [ray, hit] = camera;
    const Surface& surface = *first;
    const Vec3d direction = sample_cosine_hemisphere(surface.shading_normal, sampler.next_2d());
    const Ray probe{.origin = offset_origin(surface),
                    .direction = Vec3f(direction),
                    .t_max = glm::length(world.scene->mesh->bounds.extent())};
    recorder.hit(ray, hit, surface, Vec3d(1), Vec3d(0));
    const bool is_occluded =
        !(glm::dot(Vec3d(probe.direction), surface.geometric_normal) > 0) || rays.occluded(probe);
    recorder.occlusion(probe, is_occluded);
    return Vec3d(is_occluded ? 0 : 1);
  }
};

}  // namespace tracer
