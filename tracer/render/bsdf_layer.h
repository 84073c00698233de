// SPDX-License-Identifier: MIT
// A rough reflecting layer of the BSDF. Directions are in the frame whose z axis is the normal.
#pragma once

#include "tracer/render/bsdf_albedo.h"
#include "tracer/render/bsdf_ggx.h"

namespace tracer {

/// What is scattered along wi times |cosine of wi|, and the pdf by solid angle with which sampling
/// finds wi.
struct BsdfValue {
  Vec3d value{0};
  double pdf = 0;
};

/// Head-on and at grazing angles; between them after Schlick [Schlick 1994].
struct Reflectance {
  Vec3d head_on{0};
  double grazing = 0;

  Vec3d at(double cosine) const {
    return head_on + (Vec3d(grazing) - head_on) * schlick_weight(cosine);
  }
  /// Over the cosine-weighted hemisphere.
  Vec3d mean() const { return (20.0 * head_on + Vec3d(grazing)) / 21.0; }
  Vec3d of(const GgxAlbedo& albedo) const {
    return head_on * (albedo.full - albedo.grazing) + Vec3d(grazing) * albedo.grazing;
  }
};

/// The share of the light held back between facets that comes out in the end [Kulla 2017].
inline Vec3d multiple_reflectance(const Reflectance& reflectance, double mean_loss) {
  const Vec3d mean = reflectance.mean();
  return mean * mean * (1 - mean_loss) / (Vec3d(1) - mean * mean_loss);
}

/// Facets and their share of the light.
struct MicrofacetLayer {
  Ggx ggx;
  bool is_smooth = false;
  AlbedoTables::Row row;
  double mean_loss = 0;
  Reflectance reflectance;
  Vec3d multiple{0};

  /// Reflects nothing yet.
  MicrofacetLayer(const AlbedoTables& tables, double roughness, double anisotropy)
      : ggx(make_ggx(roughness, anisotropy)),
        is_smooth(tracer::is_smooth(roughness)),
        row(tables.row(ggx.mean_alpha())),
        mean_loss(tables.mean_loss(row)) {}

  bool empty() const { return reflectance.grazing == 0; }

  void add(double share, const Reflectance& more) {
    reflectance.head_on += share * more.head_on;
    reflectance.grazing += share * more.grazing;
    if (!is_smooth) multiple += share * multiple_reflectance(more, mean_loss);
  }

  /// The part of light along a direction of this albedo that the layer reflects.
  Vec3d albedo(const GgxAlbedo& along) const {
    return reflectance.of(along) + multiple * (1 - along.full);
  }

  /// What is reflected once; not for smooth layers.
  BsdfValue eval_single(const Vec3d& wo, const Vec3d& wi) const {
    const Vec3d h = glm::normalize(wo + wi);
    const double density = ggx.density(h) / (4 * wo.z);
    const double lambda = ggx.lambda(wo);
    return {reflectance.at(glm::dot(wo, h)) * (density / (1 + lambda + ggx.lambda(wi))),
            density / (1 + lambda)};
  }

  /// What is reflected more often, nearly diffuse.
  Vec3d eval_multiple(const GgxAlbedo& along_wo, const GgxAlbedo& along_wi, double cosine) const {
    if (is_smooth) return Vec3d(0);
    return multiple *
           ((1 - along_wo.full) * (1 - along_wi.full) * cosine / (mean_loss * std::numbers::pi));
  }

  /// A direction whose pdf is that of eval_single; below the surface where facets send it there.
  Vec3d sample(const Vec3d& wo, const Vec2d& u) const {
    return is_smooth ? Vec3d(-wo.x, -wo.y, wo.z) : mirrored(wo, ggx.sample(wo, u));
  }
};

/// What passes through `share` of a layer of one colour, for AlbedoTables::mean_product.
inline LayerWeights passing_weights(double share, const Reflectance& reflectance, double multiple) {
  const double head_on = reflectance.head_on.x;
  return {1 - share * multiple, -share * (head_on - multiple),
          -share * (reflectance.grazing - head_on)};
}

}  // namespace tracer
