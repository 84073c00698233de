// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "tracer/render/sky.h"

namespace tracer {

/// A point on a light or a direction of the sky, as seen from a surface.
struct LightSample {
  Ray shadow_ray;         // to the point, t_max = 1; both ends clear of their triangles
  Vec3d direction{};      // unit length
  Vec3d radiance{};       // towards the surface
  double pdf = 0;         // by solid angle at the surface; 0: the light turns its edge
  uint32_t triangle = 0;  // that emits; no_primitive: the sky
};

/// What the choice of a light depends on.
LightReceiver receiver_of(const Surface& surface);

/// All that shines in a world. Holds references to it.
class Lights {
 public:
  Lights(const World& world, const RenderSettings& settings);

  /// Whether there is nothing that sample() could find.
  bool empty() const { return triangle_share_ == 0 && sky_share_ == 0; }
  /// What sample() finds by the same `which`: a triangle, or no_primitive for the sky.
  struct Pick {
    uint32_t triangle = 0;
    double probability = 0;
    double rest = 0;  // of `which`, uniform in [0, 1) again
  };
  Pick pick(const LightReceiver& receiver, double which) const;
  /// The same for as many receivers at once, SampleBlock::max_size at most.
  void pick(std::span<const LightReceiver> receivers, std::span<const double> which,
            std::span<Pick> picks) const;
  /// A direction of the sky, or a triangle by power, and by place where they are many, and a point
  /// on it by area. u uniform in [0, 1)^2: points that are even in it are so over all lights
  /// together, and on each. Not empty().
  LightSample sample(const Surface& surface, const Vec2d& u) const;
  /// The pdf by solid angle with which `sample`, for that receiver, finds the point of `triangle`
  /// at distance ray.direction * t; 0 for triangles that are not among the lights.
  double pdf(const LightReceiver& receiver, uint32_t triangle, const Ray& ray, double t) const;
  /// The same of the direction of a ray that meets nothing.
  double sky_pdf(const Vec3d& direction) const {
    return sky_share_ > 0 ? sky_share_ * sky_.pdf(direction) : 0;
  }
  const Sky& sky() const { return sky_; }

 private:
  LightTree::Pick pick_triangle(const LightReceiver& receiver, double u) const;
  double probability_of(const LightReceiver& receiver, uint32_t light) const;
  LightSample sample_triangle(const Surface& surface, const Pick& pick, const Vec2d& where) const;
  LightSample sample_sky(const Surface& surface, const Vec2d& where) const;

  const Scene& scene_;
  const EmissiveTriangles& triangles_;
  Sky sky_;
  double sky_share_ = 0;       // of the samples
  double triangle_share_ = 0;  // of the samples
};

}  // namespace tracer
