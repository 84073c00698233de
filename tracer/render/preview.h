// SPDX-License-Identifier: MIT
// Integrators that show shape within a sample or two.
#pragma once

#include <array>
#include <optional>

#include "tracer/base/directions.h"
#include "tracer/render/integrator.h"
#include "tracer/render/pass_through.h"
#include "tracer/render/recorder.h"
#include "tracer/render/sampling.h"
#include "tracer/render/sky.h"

namespace tracer {

/// Where a camera ray ends; nullopt, with `miss` recorded as the sky, where it meets nothing.
template <class Recorder>
std::optional<Surface> first_surface(const World& world, const SampleBlock& block, size_t sample,
                                     const Vec3d& miss, Recorder& recorder) {
  const Ray& ray = block.camera_rays[sample];
  const Hit& hit = block.camera_hits[sample];
  recorder.camera(ray);
  if (hit.is_hit()) return surface_at(*world.scene, hit, Vec3d(ray.direction));
  recorder.sky(ray, Vec3d(1), miss);
  return std::nullopt;
}

/// Answers a block by colour(ray, surface) where camera rays end, by miss(ray) where they meet
/// nothing.
template <class Recorder, class Miss, class Colour>
void colour_first_surfaces(const World& world, const SampleBlock& block, const Miss& miss,
                           Recorder& recorder, const Colour& colour) {
  for (size_t i = 0; i < block.size(); ++i) {
    block.radiance[i] = block.camera_hits[i].is_hit() ? Vec3d(0) : miss(block.camera_rays[i]);
    const auto surface = first_surface(world, block, i, block.radiance[i], recorder);
    if (!surface) continue;
    block.radiance[i] = colour(block.camera_rays[i], *surface);
    recorder.hit(block.camera_rays[i], block.camera_hits[i], *surface, Vec3d(1), block.radiance[i]);
  }
}

/// Base colour times the cosine between view and shading normal, as if lit by a lamp on the camera,
/// plus emission; the sky where nothing is hit.
struct EyeLight {
  template <class Recorder>
  static void radiance(const World& world, RayCaster&, const RenderSettings& settings,
                       const SampleBlock& block, Recorder& recorder) {
    const Sky sky(world, settings);
    const auto miss = [&](const Ray& ray) { return sky.radiance(Vec3d(ray.direction)); };
    const auto colour = [](const Ray& ray, const Surface& surface) {
      const Vec3d view = unit_or(Vec3d(ray.direction), Vec3d(0));
      const double cosine = std::abs(glm::dot(surface.shading_normal, view));
      return Vec3d(surface.scattering.base_color) * cosine + surface.emission;
    };
    colour_first_surfaces(world, block, miss, recorder, colour);
  }
};

/// The world-space shading normal towards the viewer, (n + 1) / 2 as RGB; black where nothing is
/// hit, which no normal's colour is.
struct Normals {
  template <class Recorder>
  static void radiance(const World& world, RayCaster&, const RenderSettings&,
                       const SampleBlock& block, Recorder& recorder) {
    const auto colour = [](const Ray&, const Surface& surface) {
      return 0.5 * (surface.shading_normal + Vec3d(1));
    };
    const auto miss = [](const Ray&) { return Vec3d(0); };
    colour_first_surfaces(world, block, miss, recorder, colour);
  }
};

/// The part of cosine-weighted directions in which nothing lies within the diagonal of the bounds,
/// one direction a sample, with what thin surfaces let pass; white where nothing is hit: nothing is
/// near.
struct AmbientOcclusion {
  template <class Recorder>
  static void radiance(const World& world, RayCaster& rays, const RenderSettings&,
                       const SampleBlock& block, Recorder& recorder) {
    std::array<Ray, SampleBlock::max_size> probes;
    std::array<uint8_t, SampleBlock::max_size> is_occluded;
    std::array<size_t, SampleBlock::max_size> samples;  // that probes belong to
    size_t probe_count = 0;
    const double reach = glm::length(world.scene->mesh->bounds.extent());
    for (size_t i = 0; i < block.size(); ++i) {
      block.radiance[i] = Vec3d(1);
      const auto surface = first_surface(world, block, i, Vec3d(1), recorder);
      if (!surface) continue;
      recorder.hit(block.camera_rays[i], block.camera_hits[i], *surface, Vec3d(1), Vec3d(0));
      const Vec3d direction =
          sample_cosine_hemisphere(surface->shading_normal, block.samplers[i].next_2d());
      const Ray probe{
          .origin = offset_origin(*surface), .direction = Vec3f(direction), .t_max = reach};
      if (glm::dot(Vec3d(probe.direction), surface->geometric_normal) > 0) {
        samples[probe_count] = i;
        probes[probe_count++] = probe;
      } else {
        block.radiance[i] = Vec3d(0);
        recorder.occlusion(probe, 0);
      }
    }
    rays.occluded({probes.data(), probe_count}, {is_occluded.data(), probe_count});
    for (size_t k = 0; k < probe_count; ++k) {
      const double open =
          is_occluded[k] ? transmittance_past_hit(*world.scene, rays, probes[k]) : 1;
      block.radiance[samples[k]] = Vec3d(open);
      recorder.occlusion(probes[k], open);
    }
  }
};

}  // namespace tracer
