// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/render/integrator.h"
#include "tracer/render/recorder.h"
#include "tracer/render/sampling.h"

namespace tracer {

/// Ways of finding lights. Each alone has the same mean; together, weighted by the power
/// heuristic, the least noise.
enum class LightStrategy { combined, light_sampling, scattering };

/// Diffuse surfaces under a constant sky, lit by emissive triangles. A path scatters at most
/// settings.bounces times, and its last segment may still end on a light or in the sky: with 0,
/// only what shines by itself is seen. Paths end at random from the fourth scattering on, with the
/// rest weighted up, so that the mean stays the same. [Kajiya 1986]
template <LightStrategy strategy>
struct BasicPath {
  template <class Recorder>
  static Vec3d radiance(const World& world, RayCaster& rays, const CameraHit& camera,
                        Sampler& sampler, const RenderSettings& settings, Recorder& recorder) {
    constexpr int first_roulette = 4;
    const Scene& scene = *world.scene;
    Vec3d radiance(0);
    Vec3d throughput(1);
    double scatter_pdf = 0;  // by solid angle, of the ray's direction
    auto [ray, hit] = camera;
    recorder.camera(ray);
    for (int scatterings = 0;; ++scatterings) {
      if (scatterings > 0) hit = rays.closest_hit(ray);
      if (!hit.is_hit()) {
        radiance += throughput * world.sky;
        recorder.sky(ray, throughput, radiance);
        return radiance;
      }
      const Surface surface = surface_at(scene, hit, Vec3d(ray.direction));
      if (surface.emission != Vec3d(0)) {
        const double weight =
            scatterings == 0 ? 1 : weight_of_found_light(scene, ray, hit, scatter_pdf);
        radiance += throughput * surface.emission * weight;
      }
      recorder.hit(ray, hit, surface, throughput, radiance);

      if (scatterings == settings.bounces) return end(recorder, "bounces", radiance);
      if (surface.albedo == Vec3d(0)) return end(recorder, "absorbed", radiance);
      if (strategy != LightStrategy::scattering && !scene.lights->empty()) {
        radiance += throughput * light_from(scene, rays, surface, sampler, recorder);
      }

      // Cosine sampling: albedo / pi * cosine / pdf leaves the albedo.
      const Vec3d direction = sample_cosine_hemisphere(surface.shading_normal, sampler.next_2d());
      ray = {.origin = offset_origin(surface), .direction = Vec3f(direction)};
      if (!(glm::dot(Vec3d(ray.direction), surface.geometric_normal) > 0)) {
        return end(recorder, "below the surface", radiance);
      }
      throughput *= surface.albedo;
      scatter_pdf = pdf_cosine_hemisphere(glm::dot(direction, surface.shading_normal));
      if (scatterings + 1 >= first_roulette) {
        const double survival = std::min(1.0, std::max({throughput.x, throughput.y, throughput.z}));
        if (sampler.next() >= survival) return end(recorder, "roulette", radiance);
        throughput /= survival;
      }
    }
  }

 private:
  template <class Recorder>
  static Vec3d end(Recorder& recorder, const char* reason, const Vec3d& radiance) {
    recorder.end(reason);
    return radiance;
  }

  /// Weight of emission that a scattered ray ran into.
  static double weight_of_found_light(const Scene& scene, const Ray& ray, const Hit& hit,
                                      double scatter_pdf) {
    if (strategy == LightStrategy::scattering) return 1;
    const double pdf = pdf_light(scene, hit.primitive, ray, hit.t);
    if (strategy == LightStrategy::light_sampling) return pdf > 0 ? 0 : 1;
    return power_heuristic(scatter_pdf, pdf);
  }

  /// Radiance scattered towards the viewer from one point picked on the lights.
  template <class Recorder>
  static Vec3d light_from(const Scene& scene, RayCaster& rays, const Surface& surface,
                          Sampler& sampler, Recorder& recorder) {
    const LightSample light = sample_light(scene, surface, sampler);
    const double cosine = glm::dot(light.direction, surface.shading_normal);
    const double geometric_cosine = glm::dot(light.direction, surface.geometric_normal);
    if (!(light.pdf > 0 && cosine > 0 && geometric_cosine > 0)) {
      recorder.light(light, "behind", Vec3d(0));
      return Vec3d(0);
    }
    if (rays.occluded(light.shadow_ray)) {
      recorder.light(light, "occluded", Vec3d(0));
      return Vec3d(0);
    }
    const double scatter_pdf = pdf_cosine_hemisphere(cosine);
    const double weight =
        strategy == LightStrategy::light_sampling ? 1 : power_heuristic(light.pdf, scatter_pdf);
    // albedo / pi * cosine is albedo * scatter_pdf.
    const Vec3d found = surface.albedo * light.radiance * (weight * scatter_pdf / light.pdf);
    recorder.light(light, "visible", found);
    return found;
  }
};

using Path = BasicPath<LightStrategy::combined>;

}  // namespace tracer
