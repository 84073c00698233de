// SPDX-License-Identifier: MIT
// Light through the rough or smooth surface of clear matter [Walter 2007]. Radiance counts per
// squared index of refraction, so that matter that absorbs nothing changes none of it.
#pragma once

#include "tracer/render/bsdf_fresnel.h"
#include "tracer/render/bsdf_glass_loss.h"
#include "tracer/render/bsdf_layer.h"

namespace tracer {

/// Below this difference, matter bends no light and its facets cannot be told.
inline constexpr double least_bending = 0x1p-10;

class GlassSurface {
 public:
  /// For light towards wo, wo.z > 0, that leaves on `side`.
  GlassSurface(double ior, Side side, const Ggx& ggx, double roughness)
      : ior_(ior),
        side_(side),
        eta_(side == Side::outside ? ior : 1 / ior),
        is_clear_(ior < 1 + least_bending),
        is_smooth_(is_clear_ || tracer::is_smooth(roughness)),
        ggx_(ggx) {}

  bool is_smooth() const { return is_smooth_; }

  /// Gives back what facets hold back of light towards wo. Not for smooth surfaces.
  void add_multiple(double wo_cosine) {
    place_ = GlassLossTables::place(ggx_.mean_alpha(), ior_);
    const GlassLossTables& tables = glass_loss_tables();
    const double mean = tables.mean_loss(place_, side_);
    const double mean_beyond = tables.mean_loss(place_, other_side(side_));
    // As reciprocity wants it.
    const double beyond = eta_ * eta_ * mean_beyond / (mean + eta_ * eta_ * mean_beyond);
    const double held_back = tables.loss(place_, side_, wo_cosine);
    multiple_above_ = held_back * (1 - beyond);
    multiple_below_ = held_back * beyond;
    above_factor_ = multiple_above_ / (std::numbers::pi * mean);
    below_factor_ = multiple_below_ / (std::numbers::pi * mean_beyond);
  }
  /// Shares of light towards wo, all in all.
  double multiple_above() const { return multiple_above_; }
  double multiple_below() const { return multiple_below_; }
  /// Times |cosine of wi|, nearly diffuse.
  double eval_multiple(double wi_cosine) const {
    const double cosine = std::abs(wi_cosine);
    const GlassLossTables& tables = glass_loss_tables();
    if (wi_cosine > 0) return above_factor_ * cosine * tables.loss(place_, side_, cosine);
    return below_factor_ * cosine * tables.loss(place_, other_side(side_), cosine);
  }

  /// Not divided by anything: value / pdf is the share of light that facets do not hold back.
  /// Not for smooth surfaces.
  BsdfValue eval(const Vec3d& wo, const Vec3d& wi) const {
    return wi.z > 0 ? eval_reflection(wo, wi) : eval_transmission(wo, wi);
  }

  struct Sample {
    Vec3d wi{0};
    double probability = 0;  // of reflection or transmission, as it was chosen; 0: facets hide wi
  };
  /// For a facet with normal h, u uniform in [0, 1).
  Sample sample(const Vec3d& wo, const Vec3d& h, double u) const {
    const double cosine = glm::dot(wo, h);
    const double reflected = reflectance(cosine);
    if (u < reflected) {
      const Vec3d wi = mirrored(wo, h);
      return {wi, wi.z > 0 ? reflected : 0};
    }
    if (is_clear_) return {-wo, 1};
    const double squared = 1 - (1 - cosine * cosine) / (eta_ * eta_);
    const double beyond = std::sqrt(std::max(0.0, squared));
    const Vec3d wi = glm::normalize((cosine / eta_ - beyond) * h - wo / eta_);
    return {wi, wi.z < 0 ? 1 - reflected : 0};
  }
  Vec3d sample_facet(const Vec3d& wo, const Vec2d& u) const {
    return is_smooth_ ? Vec3d(0, 0, 1) : ggx_.sample(wo, u);
  }

 private:
  double reflectance(double cosine) const {
    return is_clear_ ? 0 : fresnel_dielectric(cosine, eta_);
  }

  BsdfValue eval_reflection(const Vec3d& wo, const Vec3d& wi) const {
    const Vec3d h = glm::normalize(wo + wi);
    const double lambda = ggx_.lambda(wo);
    const double pdf = reflectance(glm::dot(wo, h)) * ggx_.density(h) / (4 * wo.z * (1 + lambda));
    return {Vec3d(pdf * (1 + lambda) / (1 + lambda + ggx_.lambda(wi))), pdf};
  }

  BsdfValue eval_transmission(const Vec3d& wo, const Vec3d& wi) const {
    Vec3d h = glm::normalize(wo + eta_ * wi);
    if (h.z < 0) h = -h;
    const double cosine = glm::dot(wo, h);
    const double beyond = -glm::dot(wi, h);
    if (!(cosine > 0 && beyond > 0)) return {};
    const double bend = cosine - eta_ * beyond;
    const double pdf =
        (1 - reflectance(cosine)) * ggx_.visible_pdf(wo, h) * eta_ * eta_ * beyond / (bend * bend);
    return {Vec3d(pdf / (1 + ggx_.lambda(wi))), pdf};
  }

  double ior_;
  Side side_;
  double eta_;
  bool is_clear_;
  bool is_smooth_;
  Ggx ggx_;
  GlassLossTables::Place place_;
  double multiple_above_ = 0;
  double multiple_below_ = 0;
  double above_factor_ = 0;
  double below_factor_ = 0;
};

}  // namespace tracer
