// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "tracer/base/directions.h"
#include "tracer/render/bsdf.h"
#include "tracer/render/sampler.h"
#include "tracer/scene/scene.h"

namespace tracer {

/// What a surface scatters towards the viewer out of a direction in the world.
struct Scattering {
  Vec3d direction{0};           // unit length, away from the surface
  Vec3d weight{0};              // value times |cosine| / pdf
  double pdf = 0;               // by solid angle; 0: nothing; infinite: of a smooth layer
  bool is_transmitted = false;  // from behind the surface
};

/// Where a mirror about `normal` would send light towards the viewer from below the surface,
/// the nearest normal that does not; `normal` elsewhere.
inline Vec3d bent_normal(const Vec3d& normal, const Vec3d& geometric_normal, const Vec3d& viewer) {
  const double up = glm::dot(viewer, geometric_normal);
  const Vec3d mirror = mirrored(viewer, normal);
  const double height = glm::dot(mirror, geometric_normal);
  if (glm::dot(viewer, normal) > 0 && height > 0) return normal;
  // A little above the plane, less where the viewer is low as well.
  const Vec3d raised = mirror + (up / 16 - height) * geometric_normal;
  return unit_or(viewer + unit_or(raised, geometric_normal), geometric_normal);
}

/// The frame of Bsdf: z the normal, x level where y is up, turned by the anisotropy.
struct ScatteringFrame {
  Vec3d x, y, z;

  ScatteringFrame(const Vec3d& normal, double turns) : z(normal) {
    const Vec3d level = unit_or({normal.z, 0, -normal.x}, tangents_of(normal).x);
    const Vec3d across = glm::cross(normal, level);
    const CosSin turned = cos_sin_of_turns(turns);
    x = turned.cos * level + turned.sin * across;
    y = turned.cos * across - turned.sin * level;
  }

  Vec3d to_local(const Vec3d& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
  Vec3d to_world(const Vec3d& v) const { return v.x * x + v.y * y + v.z * z; }
};

/// A surface as the viewer sees it. Lambert's surfaces have the same bits whatever `features`.
template <BsdfFeatures features>
class SurfaceScattering {
 public:
  SurfaceScattering(const Surface& surface, const Vec3d& viewer) : surface_(surface) {
    if constexpr (features != BsdfFeatures::diffuse) {
      if (!is_lambert(surface.scattering)) glossy_.emplace(surface, viewer);
    }
  }

  /// Of a unit direction. Smooth layers count as nothing.
  Scattering eval(const Vec3d& direction) const {
    if constexpr (features != BsdfFeatures::diffuse) {
      if (glossy_) return glossy_->eval(surface_, direction);
    }
    const double cosine = glm::dot(direction, surface_.shading_normal);
    if (!(cosine > 0 && glm::dot(direction, surface_.geometric_normal) > 0)) return {};
    return {direction, color(), pdf_cosine_hemisphere(cosine), false};
  }

  Scattering sample(Sampler& sampler) const {
    if constexpr (features != BsdfFeatures::diffuse) {
      if (glossy_) return glossy_->sample(sampler);
    }
    const Vec3d& normal = surface_.shading_normal;
    const Vec3d direction = sample_cosine_hemisphere(normal, sampler.next_2d());
    // Cosine sampling: color / pi * cosine / pdf leaves the color.
    return {direction, color(), pdf_cosine_hemisphere(glm::dot(direction, normal)), false};
  }

 private:
  struct Glossy {
    ScatteringFrame frame;
    Bsdf<features> bsdf;

    Glossy(const Surface& surface, const Vec3d& viewer)
        : Glossy(
              ScatteringFrame(bent_normal(surface.shading_normal, surface.geometric_normal, viewer),
                              surface.scattering.anisotropy_turns),
              surface, viewer) {}
    Glossy(const ScatteringFrame& around, const Surface& surface, const Vec3d& viewer)
        : frame(around),
          bsdf(surface.scattering, around.to_local(viewer),
               surface.is_front ? Side::outside : Side::inside) {}

    Scattering eval(const Surface& surface, const Vec3d& direction) const {
      const Vec3d wi = frame.to_local(direction);
      // Both normals must have it on the same side.
      if (!(wi.z * glm::dot(direction, surface.geometric_normal) > 0)) return {};
      const BsdfValue found = bsdf.eval(wi);
      if (!(found.pdf > 0)) return {};
      return {direction, found.value / found.pdf, found.pdf, wi.z < 0};
    }

    Scattering sample(Sampler& sampler) const {
      const double u_lobe = sampler.next();
      const BsdfSample found = bsdf.sample(u_lobe, sampler.next_2d());
      return {frame.to_world(found.wi), found.weight, found.pdf, found.wi.z < 0};
    }
  };

  Vec3d color() const { return Vec3d(surface_.scattering.base_color); }

  const Surface& surface_;
  std::optional<Glossy> glossy_;
};

}  // namespace tracer
