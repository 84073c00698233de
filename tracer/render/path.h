// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>

#include "tracer/render/bsdf_surface.h"
#include "tracer/render/diffuse_paths.h"
#include "tracer/render/integrator.h"
#include "tracer/render/pass_through.h"
#include "tracer/render/recorder.h"
#include "tracer/render/sampling.h"

namespace tracer {

/// Ways of finding lights. Each alone has the same mean; together, weighted by the power
/// heuristic, the least noise.
enum class LightStrategy { combined, light_sampling, scattering };

/// The paths of a block, a vertex at a time: what all of them hit is shaded, then all shadow rays
/// are traced, then all next rays; paths that end are dropped from the arrays. [Laine 2013]
/// No surface has more than `features`.
template <LightStrategy strategy, BsdfFeatures features, class Recorder>
class PathWavefront {
 public:
  PathWavefront(const World& world, RayCaster& caster, const RenderSettings& settings,
                const SampleBlock& block, Recorder& recorder)
      : scene_(*world.scene),
        caster_(caster),
        settings_(settings),
        block_(block),
        recorder_(recorder),
        lights_(world, settings),
        pixel_spread_(glm::length(world.camera.right_step)) {}

  void run() {
    start();
    for (int scatterings = 0;; ++scatterings) {
      shade(scatterings);
      if (strategy != LightStrategy::scattering && !lights_.empty()) {
        add_light(scatterings);
      }
      scatter(scatterings);
      if (count_ == 0) return;
      caster_.closest_hits({rays_.data(), count_}, {hits_.data(), count_});
      if (scene_.surfaces.has_alpha) pass_through();
    }
  }

 private:
  template <class T>
  using Array = std::array<T, SampleBlock::max_size>;

  struct Path {
    size_t sample;  // of the block
    Vec3d throughput;
    double scatter_pdf;  // by solid angle, of the ray's direction; infinite: as in Scattering
    LightReceiver from;  // where it was scattered
    Vec3d viewer;        // unit length, whence the ray came
    // Of the cone that the ray stands for: where it begins, and more at each unit of its way.
    double width, spread;
  };

  /// What a path's vertex scatters towards the viewer if nothing hides the light.
  struct Scattered {
    size_t path;
    LightSample light;
    Vec3d radiance;
  };

  void start() {
    count_ = block_.size();
    for (size_t i = 0; i < count_; ++i) {
      paths_[i] = {i, Vec3d(1), 0, {}, Vec3d(0), 0, pixel_spread_};
      rays_[i] = block_.camera_rays[i];
      hits_[i] = block_.camera_hits[i];
      block_.radiance[i] = Vec3d(0);
      recorder_.camera(rays_[i]);
    }
  }

  void pass_through() {
    for (size_t i = 0; i < count_; ++i) {
      Sampler& sampler = block_.samplers[paths_[i].sample];
      hits_[i] = tracer::pass_through(scene_, caster_, sampler, rays_[i], hits_[i]);
    }
  }

  /// Adds what the hits emit. The paths that may scatter stay, with their surfaces.
  void shade(int scatterings) {
    size_t kept = 0;
    for (size_t i = 0; i < count_; ++i) {
      if (shade(paths_[i], rays_[i], hits_[i], scatterings, surfaces_[kept])) {
        paths_[kept++] = paths_[i];
      }
    }
    count_ = kept;
  }

  bool shade(Path& path, const Ray& ray, const Hit& hit, int scatterings, Surface& surface) {
    Vec3d& radiance = block_.radiance[path.sample];
    if (!hit.is_hit()) {
      const Vec3d direction(ray.direction);
      const double weight = scatterings == 0 ? 1 : weight_of_found_sky(direction, path.scatter_pdf);
      const Vec3d found = path.throughput * lights_.sky().radiance(direction) * weight;
      radiance += limited(found, scatterings);
      recorder_.sky(ray, path.throughput, radiance);
      return false;
    }
    path.width += path.spread * hit.t;
    surface = surface_at(scene_, hit, Vec3d(ray.direction), path.width);
    if (surface.emission != Vec3d(0)) {
      const double weight = scatterings == 0 ? 1 : weight_of_found_light(path, ray, hit);
      radiance += limited(path.throughput * surface.emission * weight, scatterings);
    }
    recorder_.hit(ray, hit, surface, path.throughput, radiance);
    if (scatterings == settings_.bounces) return end("bounces");
    if (is_black(surface.scattering)) return end("absorbed");
    if constexpr (features != BsdfFeatures::diffuse) {
      path.viewer = unit_or(-Vec3d(ray.direction), surface.geometric_normal);
    }
    return true;
  }

  static bool is_black(const Principled& scattering) {
    return scattering.base_color == Vec3f(0) && is_lambert(scattering);
  }

  /// Light that was scattered so often on its way: direct light is never cut.
  Vec3d limited(const Vec3d& light, int scatterings) const {
    if (settings_.clamp == 0 || scatterings < 2) return light;
    const double largest = max_abs(light);
    return largest > settings_.clamp ? light * (settings_.clamp / largest) : light;
  }

  bool end(const char* reason) {
    recorder_.end(reason);
    return false;
  }

  /// Weight of emission that a scattered ray ran into.
  double weight_of_found_light(const Path& path, const Ray& ray, const Hit& hit) const {
    if (strategy == LightStrategy::scattering) return 1;
    return weight_beside(lights_.pdf(path.from, hit.primitive, ray, hit.t), path.scatter_pdf);
  }

  double weight_of_found_sky(const Vec3d& direction, double scatter_pdf) const {
    if (strategy == LightStrategy::scattering) return 1;
    return weight_beside(lights_.sky_pdf(direction), scatter_pdf);
  }

  // Of what scattering found, where light sampling finds the same with `light_pdf`.
  static double weight_beside(double light_pdf, double scatter_pdf) {
    // Nothing but a smooth layer finds what it mirrors.
    if (std::isinf(scatter_pdf)) return 1;
    if (strategy == LightStrategy::light_sampling) return light_pdf > 0 ? 0 : 1;
    return power_heuristic(scatter_pdf, light_pdf);
  }

  /// Adds what each surface scatters from a point picked on the lights.
  void add_light(int scatterings) {
    size_t shadow_count = 0;
    for (size_t i = 0; i < count_; ++i) {
      Scattered& scattered = scattered_[shadow_count];
      scattered.path = i;
      if (!pick_light(paths_[i], surfaces_[i], scattered)) continue;
      shadow_rays_[shadow_count++] = scattered.light.shadow_ray;
    }
    caster_.occluded({shadow_rays_.data(), shadow_count}, {is_occluded_.data(), shadow_count});
    for (size_t k = 0; k < shadow_count; ++k) {
      const auto& [i, light, radiance] = scattered_[k];
      const double share =
          is_occluded_[k] ? transmittance_past_hit(scene_, caster_, shadow_rays_[k]) : 1;
      if (share == 0) {
        recorder_.light(light, "occluded", Vec3d(0));
        continue;
      }
      const Vec3d arriving = share * radiance;
      recorder_.light(light, "visible", arriving);
      block_.radiance[paths_[i].sample] +=
          limited(paths_[i].throughput * arriving, scatterings + 1);
    }
  }

  // False where the surface scatters none of the light towards the viewer.
  bool pick_light(const Path& path, const Surface& surface, Scattered& scattered) {
    LightSample& light = scattered.light;
    Sampler& sampler = block_.samplers[path.sample];
    light = lights_.sample(surface, sampler.next_2d());
    const Scattering found =
        SurfaceScattering<features>(surface, path.viewer).eval(light.direction);
    if (!(light.pdf > 0 && found.pdf > 0)) {
      recorder_.light(light, "behind", Vec3d(0));
      return false;
    }
    if (found.is_transmitted) light.shadow_ray = from_behind(surface, light.shadow_ray);
    const double weight =
        strategy == LightStrategy::light_sampling ? 1 : power_heuristic(light.pdf, found.pdf);
    scattered.radiance = found.weight * light.radiance * (weight * found.pdf / light.pdf);
    return true;
  }

  /// A ray to the same end.
  static Ray from_behind(const Surface& surface, Ray ray) {
    const Vec3d moved = Vec3d(ray.origin) - Vec3d(offset_origin_behind(surface));
    if (std::isfinite(ray.t_max)) ray.direction = Vec3f(Vec3d(ray.direction) + moved / ray.t_max);
    ray.origin = offset_origin_behind(surface);
    return ray;
  }

  /// Gives the paths their next rays. Those that go on stay.
  void scatter(int scatterings) {
    size_t kept = 0;
    for (size_t i = 0; i < count_; ++i) {
      if (scatter(paths_[i], surfaces_[i], scatterings, rays_[kept])) paths_[kept++] = paths_[i];
    }
    count_ = kept;
  }

  bool scatter(Path& path, const Surface& surface, int scatterings, Ray& ray) {
    Sampler& sampler = block_.samplers[path.sample];
    const Scattering found = SurfaceScattering<features>(surface, path.viewer).sample(sampler);
    ray = {.origin = found.is_transmitted ? offset_origin_behind(surface) : offset_origin(surface),
           .direction = Vec3f(found.direction)};
    const double up = glm::dot(Vec3d(ray.direction), surface.geometric_normal);
    if (!(found.is_transmitted ? up < 0 : up > 0)) return end("below the surface");
    Vec3d& throughput = path.throughput;
    throughput *= found.weight;
    if (throughput == Vec3d(0)) return end("absorbed");
    path.from = receiver_of(surface);
    path.scatter_pdf = found.pdf;
    // A part of the lobe: textures are seen through others too.
    path.spread = std::max(path.spread, std::min(0.1 / std::sqrt(found.pdf), 0.3));
    if (scatterings + 1 >= first_roulette) {
      const double survival = survival_probability(throughput);
      if (sampler.next() >= survival) return end("roulette");
      throughput /= survival;
    }
    return true;
  }

  const Scene& scene_;
  RayCaster& caster_;
  const RenderSettings& settings_;
  const SampleBlock& block_;
  Recorder& recorder_;
  const Lights lights_;
  const double pixel_spread_;  // of camera rays

  // The paths under way, in the order of their samples: [0, count_) of each array.
  size_t count_ = 0;
  Array<Path> paths_;
  Array<Ray> rays_;
  Array<Hit> hits_;
  Array<Surface> surfaces_;
  // Of those that a light may reach.
  Array<Scattered> scattered_;
  Array<Ray> shadow_rays_;
  Array<uint8_t> is_occluded_;
};

/// Surfaces lit by the sky and by emissive triangles. A path scatters at most
/// settings.bounces times, and its last segment may still end on a light or in the sky: with 0,
/// only what shines by itself is seen. Long paths end at random, with the rest weighted up, so that
/// the mean stays the same. [Kajiya 1986]
template <LightStrategy strategy>
struct BasicPath {
  template <class Recorder>
  static void radiance(const World& world, RayCaster& rays, const RenderSettings& settings,
                       const SampleBlock& block, Recorder& recorder) {
    if constexpr (strategy == LightStrategy::combined && std::is_same_v<Recorder, NoRecorder>) {
      if (settings.skips && can_find_diffuse_paths(world, settings)) {
        return diffuse_paths(world, rays, settings, block);
      }
    }
    using enum BsdfFeatures;
    const BsdfFeatures missing = settings.skips ? without(world.scene->surfaces.features) : diffuse;
    const auto run = [&]<BsdfFeatures features>() {
      PathWavefront<strategy, features, Recorder>(world, rays, settings, block, recorder).run();
    };
    if (missing == all) return run.template operator()<diffuse>();
    if (has(missing, layers | transmission)) return run.template operator()<reflection>();
    if (has(missing, transmission)) return run.template operator()<reflection | layers>();
    run.template operator()<all>();
  }
};

using Path = BasicPath<LightStrategy::combined>;

}  // namespace tracer
