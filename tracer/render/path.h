// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>

#include "tracer/render/diffuse_paths.h"
#include "tracer/render/integrator.h"
#include "tracer/render/recorder.h"
#include "tracer/render/sampling.h"

namespace tracer {

/// Ways of finding lights. Each alone has the same mean; together, weighted by the power
/// heuristic, the least noise.
enum class LightStrategy { combined, light_sampling, scattering };

/// The paths of a block, a vertex at a time: what all of them hit is shaded, then all shadow rays
/// are traced, then all next rays; paths that end are dropped from the arrays. [Laine 2013]
template <LightStrategy strategy, class Recorder>
class PathWavefront {
 public:
  PathWavefront(const World& world, RayCaster& caster, const RenderSettings& settings,
                const SampleBlock& block, Recorder& recorder)
      : scene_(*world.scene),
        caster_(caster),
        settings_(settings),
        block_(block),
        recorder_(recorder),
        lights_(world, settings) {}

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
    }
  }

 private:
  template <class T>
  using Array = std::array<T, SampleBlock::max_size>;

  struct Path {
    size_t sample;  // of the block
    Vec3d throughput;
    double scatter_pdf;  // by solid angle, of the ray's direction
    LightReceiver from;  // where it was scattered
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
      paths_[i] = {i, Vec3d(1), 0, {}};
      rays_[i] = block_.camera_rays[i];
      hits_[i] = block_.camera_hits[i];
      block_.radiance[i] = Vec3d(0);
      recorder_.camera(rays_[i]);
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

  bool shade(const Path& path, const Ray& ray, const Hit& hit, int scatterings, Surface& surface) {
    Vec3d& radiance = block_.radiance[path.sample];
    if (!hit.is_hit()) {
      const Vec3d direction(ray.direction);
      const double weight = scatterings == 0 ? 1 : weight_of_found_sky(direction, path.scatter_pdf);
      const Vec3d found = path.throughput * lights_.sky().radiance(direction) * weight;
      radiance += limited(found, scatterings);
      recorder_.sky(ray, path.throughput, radiance);
      return false;
    }
    surface = surface_at(scene_, hit, Vec3d(ray.direction));
    if (surface.emission != Vec3d(0)) {
      const double weight = scatterings == 0 ? 1 : weight_of_found_light(path, ray, hit);
      radiance += limited(path.throughput * surface.emission * weight, scatterings);
    }
    recorder_.hit(ray, hit, surface, path.throughput, radiance);
    if (scatterings == settings_.bounces) return end("bounces");
    if (surface.scattering.base_color == Vec3f(0)) return end("absorbed");
    return true;
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
    if (strategy == LightStrategy::light_sampling) return light_pdf > 0 ? 0 : 1;
    return power_heuristic(scatter_pdf, light_pdf);
  }

  /// Adds what each surface scatters from a point picked on the lights.
  void add_light(int scatterings) {
    size_t shadow_count = 0;
    for (size_t i = 0; i < count_; ++i) {
      Scattered& scattered = scattered_[shadow_count];
      scattered.path = i;
      if (!pick_light(surfaces_[i], block_.samplers[paths_[i].sample], scattered)) continue;
      shadow_rays_[shadow_count++] = scattered.light.shadow_ray;
    }
    caster_.occluded({shadow_rays_.data(), shadow_count}, {is_occluded_.data(), shadow_count});
    for (size_t k = 0; k < shadow_count; ++k) {
      const auto& [i, light, radiance] = scattered_[k];
      if (is_occluded_[k]) {
        recorder_.light(light, "occluded", Vec3d(0));
        continue;
      }
      recorder_.light(light, "visible", radiance);
      block_.radiance[paths_[i].sample] +=
          limited(paths_[i].throughput * radiance, scatterings + 1);
    }
  }

  // False where the light is behind the surface.
  bool pick_light(const Surface& surface, Sampler& sampler, Scattered& scattered) {
    LightSample& light = scattered.light;
    const double which = sampler.next();
    light = lights_.sample(surface, which, sampler.next_2d());
    const double cosine = glm::dot(light.direction, surface.shading_normal);
    const double geometric_cosine = glm::dot(light.direction, surface.geometric_normal);
    if (!(light.pdf > 0 && cosine > 0 && geometric_cosine > 0)) {
      recorder_.light(light, "behind", Vec3d(0));
      return false;
    }
    const double scatter_pdf = pdf_cosine_hemisphere(cosine);
    const double weight =
        strategy == LightStrategy::light_sampling ? 1 : power_heuristic(light.pdf, scatter_pdf);
    // albedo / pi * cosine is albedo * scatter_pdf.
    scattered.radiance =
        Vec3d(surface.scattering.base_color) * light.radiance * (weight * scatter_pdf / light.pdf);
    return true;
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
    constexpr int first_roulette = 4;
    Sampler& sampler = block_.samplers[path.sample];
    // Cosine sampling: albedo / pi * cosine / pdf leaves the albedo.
    const Vec3d direction = sample_cosine_hemisphere(surface.shading_normal, sampler.next_2d());
    ray = {.origin = offset_origin(surface), .direction = Vec3f(direction)};
    if (!(glm::dot(Vec3d(ray.direction), surface.geometric_normal) > 0)) {
      return end("below the surface");
    }
    Vec3d& throughput = path.throughput;
    throughput *= Vec3d(surface.scattering.base_color);
    path.from = receiver_of(surface);
    path.scatter_pdf = pdf_cosine_hemisphere(glm::dot(direction, surface.shading_normal));
    if (scatterings + 1 >= first_roulette) {
      const double survival = std::min(1.0, std::max({throughput.x, throughput.y, throughput.z}));
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

/// Diffuse surfaces lit by the sky and by emissive triangles. A path scatters at most
/// settings.bounces times, and its last segment may still end on a light or in the sky: with 0,
/// only what shines by itself is seen. Paths end at random from the fourth scattering on, with the
/// rest weighted up, so that the mean stays the same. [Kajiya 1986]
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
    PathWavefront<strategy, Recorder>(world, rays, settings, block, recorder).run();
  }
};

using Path = BasicPath<LightStrategy::combined>;

}  // namespace tracer
