// SPDX-License-Identifier: MIT
// The one BSDF: Principled, between two directions. docs/materials.md has the formulas.
#pragma once

#include <limits>

#include "tracer/render/bsdf_glass.h"
#include "tracer/render/bsdf_layer.h"
#include "tracer/render/sampling.h"
#include "tracer/scene/bsdf_features.h"

namespace tracer {

struct BsdfSample {
  Vec3d wi{0};
  Vec3d weight{0};           // value times |cosine| / pdf; 0: nothing is scattered
  double pdf = 0;            // by solid angle; infinite where is_specular
  bool is_specular = false;  // of a smooth layer: no other direction is like it
};

/// Scatters light towards wo; directions are unit length in the frame whose z axis is the shading
/// normal on wo's side and whose x axis is that of the anisotropy, wo.z > 0. Layers that are not
/// among `features` must have no share in `p`.
template <BsdfFeatures features>
class Bsdf {
 public:
  Bsdf(const Principled& p, const Vec3d& wo, Side side = Side::outside);

  /// Smooth layers scatter along single directions, which have no value here.
  BsdfValue eval(const Vec3d& wi) const;
  /// u_lobe uniform in [0, 1), u in [0, 1)^2.
  BsdfSample sample(double u_lobe, const Vec2d& u) const;

 private:
  static constexpr bool has_reflection = has(features, BsdfFeatures::reflection);
  static constexpr bool has_layers = has(features, BsdfFeatures::layers);
  static constexpr bool has_transmission = has(features, BsdfFeatures::transmission);

  /// What reaches each layer along a direction.
  struct Passage {
    GgxAlbedo coat;
    GgxAlbedo gloss;
    double sheen = 0;  // albedo
    double below_coat = 1;
    double below_sheen = 1;
    double below_gloss = 1;
  };
  Passage passage(double cosine) const;
  static double through(double of_wo, double of_wi) { return std::min(of_wo, of_wi); }

  void set_gloss(const Principled& p, double dielectric);
  void set_mean_passage();
  void set_probabilities();

  BsdfValue eval_reflection(const Vec3d& wi) const;
  BsdfValue eval_transmission(const Vec3d& wi) const;
  BsdfSample sample_glass(double u_lobe, const Vec2d& u) const;
  BsdfSample specular(const Vec3d& wi, const Vec3d& value, double probability) const;
  BsdfSample evaluated(const Vec3d& wi) const;
  /// Nothing where other facets hide wi.
  BsdfSample mirrored_by_facet(const Vec3d& wi) const {
    return wi.z > 0 ? evaluated(wi) : BsdfSample{.wi = wi};
  }

  const AlbedoTables& tables_;
  Vec3d wo_;
  // Shares of the base, and what each does.
  Vec3d diffuse_;
  Vec3d transmitted_;  // colour of the glass times its share
  double glass_share_;
  MicrofacetLayer gloss_;
  GlassSurface glass_;
  // Of the dielectric alone, which covers the diffuse base.
  Reflectance dielectric_;
  double dielectric_multiple_ = 0;
  double sheen_;
  double coat_share_;
  MicrofacetLayer coat_;

  Passage from_wo_;
  double mean_passage_ = 1;  // to the diffuse base
  // Of sampling; they add up to 1.
  struct {
    double cosine = 1;
    double gloss = 0;
    double coat = 0;
    double glass = 0;
    double behind = 0;  // the cosine of directions behind the surface
  } probability_;
};

template <BsdfFeatures features>
Bsdf<features>::Bsdf(const Principled& p, const Vec3d& wo, Side side)
    : tables_(albedo_tables()),
      wo_(wo),
      diffuse_(Vec3d(p.base_color) * ((1.0 - p.metallic) * (1.0 - p.transmission))),
      transmitted_(Vec3d(p.base_color) * ((1.0 - p.metallic) * p.transmission)),
      glass_share_((1.0 - p.metallic) * p.transmission),
      gloss_(tables_, p.roughness, p.anisotropy),
      glass_(p.ior, side, gloss_.ggx, p.roughness),
      sheen_(p.sheen * (1.0 - p.metallic) * (1.0 - p.transmission)),
      coat_share_(p.coat),
      coat_(tables_, p.coat_roughness, 0) {
  if constexpr (has_reflection) set_gloss(p, (1.0 - p.metallic) * (1.0 - p.transmission));
  if constexpr (has_layers) coat_.add(1, {Vec3d(0.04), 1});
  if constexpr (has_transmission) {
    if (glass_share_ > 0 && !glass_.is_smooth()) glass_.add_multiple(wo.z);
  }
  from_wo_ = passage(wo.z);
  set_mean_passage();
  set_probabilities();
}

template <BsdfFeatures features>
void Bsdf<features>::set_gloss(const Principled& p, double dielectric) {
  gloss_.add(p.metallic, {Vec3d(p.base_color), 1});
  // Below 2 %, reflectance at grazing angles fades as well.
  dielectric_ = {Vec3d(0.08 * p.specular), std::min(1.0, 4.0 * p.specular)};
  gloss_.add(dielectric, dielectric_);
  if (!gloss_.is_smooth) {
    dielectric_multiple_ = multiple_reflectance(dielectric_, gloss_.mean_loss).x;
  }
}

template <BsdfFeatures features>
auto Bsdf<features>::passage(double cosine) const -> Passage {
  Passage result;
  if constexpr (has_layers) {
    if (coat_share_ > 0) {
      result.coat = tables_.ggx(coat_.row, cosine);
      result.below_coat = 1 - coat_share_ * coat_.albedo(result.coat).x;
    }
    if (sheen_ > 0) result.sheen = tables_.sheen(cosine);
    result.below_sheen = result.below_coat * (1 - sheen_ * result.sheen);
  }
  result.below_gloss = result.below_sheen;
  if constexpr (has_reflection) {
    if (!gloss_.empty()) {
      result.gloss = tables_.ggx(gloss_.row, cosine);
      const double reflected =
          dielectric_.of(result.gloss).x + dielectric_multiple_ * (1 - result.gloss.full);
      result.below_gloss *= 1 - reflected;
    }
  }
  return result;
}

template <BsdfFeatures features>
void Bsdf<features>::set_mean_passage() {
  if constexpr (has_reflection || has_layers) {
    if (diffuse_ == Vec3d(0)) return;
    if (coat_share_ == 0 && sheen_ == 0 && dielectric_.grazing == 0) return;
    mean_passage_ = tables_.mean_product(
        {1, -sheen_, 0}, passing_weights(coat_share_, coat_.reflectance, coat_.multiple.x),
        coat_.row, passing_weights(1, dielectric_, dielectric_multiple_), gloss_.row);
  }
}

// As much as each may scatter, as far as wo tells.
template <BsdfFeatures features>
void Bsdf<features>::set_probabilities() {
  if constexpr (features == BsdfFeatures::diffuse) return;
  auto& [cosine, gloss, coat, glass, behind] = probability_;
  cosine = luminance(diffuse_) * from_wo_.below_gloss +
           sheen_ * from_wo_.sheen * from_wo_.below_coat +
           luminance(gloss_.multiple) * (1 - from_wo_.gloss.full) * from_wo_.below_sheen;
  if constexpr (has_reflection) {
    gloss = luminance(gloss_.reflectance.of(from_wo_.gloss)) * from_wo_.below_sheen;
  }
  if constexpr (has_layers) {
    coat = coat_share_ * coat_.reflectance.of(from_wo_.coat).x;
    cosine += coat_share_ * coat_.multiple.x * (1 - from_wo_.coat.full);
  }
  if constexpr (has_transmission) {
    const double share = glass_share_ * from_wo_.below_sheen;
    cosine += share * glass_.multiple_above();
    behind = luminance(transmitted_) * from_wo_.below_sheen * glass_.multiple_below();
    glass = share * (1 - glass_.multiple_above() - glass_.multiple_below());
  }
  const double sum = cosine + gloss + coat + glass + behind;
  if (!(sum > 0)) {
    probability_ = {};
    return;
  }
  cosine /= sum, gloss /= sum, coat /= sum, glass /= sum, behind /= sum;
}

template <BsdfFeatures features>
BsdfValue Bsdf<features>::eval(const Vec3d& wi) const {
  if (wi.z > 0) return eval_reflection(wi);
  if constexpr (has_transmission) {
    if (wi.z < 0 && !glass_.is_smooth()) return eval_transmission(wi);
  }
  return {};
}

template <BsdfFeatures features>
BsdfValue Bsdf<features>::eval_reflection(const Vec3d& wi) const {
  const Passage from_wi = passage(wi.z);
  const double cosine = pdf_cosine_hemisphere(wi.z);
  BsdfValue result{diffuse_ * (cosine * from_wo_.below_gloss * from_wi.below_gloss / mean_passage_),
                   probability_.cosine * cosine};
  const double to_base = through(from_wo_.below_sheen, from_wi.below_sheen);
  const auto add = [&](const BsdfValue& layer, double share, double probability) {
    result.value += share * layer.value;
    result.pdf += probability * layer.pdf;
  };
  if constexpr (has_reflection) {
    if (!gloss_.empty() && !gloss_.is_smooth) {
      add(gloss_.eval_single(wo_, wi), to_base, probability_.gloss);
      result.value += to_base * gloss_.eval_multiple(from_wo_.gloss, from_wi.gloss, wi.z);
    }
  }
  if constexpr (has_layers) {
    if (sheen_ > 0) {
      const double half = glm::dot(wo_, glm::normalize(wo_ + wi));
      result.value += Vec3d(sheen_ * schlick_weight(half) * wi.z *
                            through(from_wo_.below_coat, from_wi.below_coat));
    }
    if (coat_share_ > 0 && !coat_.is_smooth) {
      add(coat_.eval_single(wo_, wi), coat_share_, probability_.coat);
      result.value += coat_share_ * coat_.eval_multiple(from_wo_.coat, from_wi.coat, wi.z);
    }
  }
  if constexpr (has_transmission) {
    if (glass_share_ > 0 && !glass_.is_smooth()) {
      add(glass_.eval(wo_, wi), glass_share_ * to_base, probability_.glass);
      result.value += Vec3d(glass_share_ * to_base * glass_.eval_multiple(wi.z));
    }
  }
  return result;
}

template <BsdfFeatures features>
BsdfValue Bsdf<features>::eval_transmission(const Vec3d& wi) const {
  const BsdfValue glass = glass_.eval(wo_, wi);
  const double share = through(from_wo_.below_sheen, passage(-wi.z).below_sheen);
  return {transmitted_ * (share * (glass.value.x + glass_.eval_multiple(wi.z))),
          probability_.glass * glass.pdf + probability_.behind * pdf_cosine_hemisphere(-wi.z)};
}

template <BsdfFeatures features>
BsdfSample Bsdf<features>::specular(const Vec3d& wi, const Vec3d& value, double probability) const {
  return {wi, value / probability, std::numeric_limits<double>::infinity(), true};
}

template <BsdfFeatures features>
BsdfSample Bsdf<features>::evaluated(const Vec3d& wi) const {
  const BsdfValue found = eval(wi);
  if (!(found.pdf > 0)) return {.wi = wi};
  return {wi, found.value / found.pdf, found.pdf, false};
}

template <BsdfFeatures features>
BsdfSample Bsdf<features>::sample(double u_lobe, const Vec2d& u) const {
  if constexpr (has_reflection) {
    if (u_lobe < probability_.gloss) {
      const Vec3d wi = gloss_.sample(wo_, u);
      if (!gloss_.is_smooth) return mirrored_by_facet(wi);
      return specular(wi, from_wo_.below_sheen * gloss_.reflectance.at(wo_.z), probability_.gloss);
    }
    u_lobe -= probability_.gloss;
  }
  if constexpr (has_layers) {
    if (u_lobe < probability_.coat) {
      const Vec3d wi = coat_.sample(wo_, u);
      if (!coat_.is_smooth) return mirrored_by_facet(wi);
      return specular(wi, coat_share_ * coat_.reflectance.at(wo_.z), probability_.coat);
    }
    u_lobe -= probability_.coat;
  }
  if constexpr (has_transmission) {
    if (u_lobe < probability_.glass) return sample_glass(u_lobe / probability_.glass, u);
    u_lobe -= probability_.glass;
    if (u_lobe < probability_.behind) return evaluated(sample_cosine_hemisphere({0, 0, -1}, u));
  }
  return evaluated(sample_cosine_hemisphere({0, 0, 1}, u));
}

template <BsdfFeatures features>
BsdfSample Bsdf<features>::sample_glass(double u_lobe, const Vec2d& u) const {
  const auto [wi, probability] = glass_.sample(wo_, glass_.sample_facet(wo_, u), u_lobe);
  if (!(probability > 0)) return {.wi = wi};
  if (!glass_.is_smooth()) return evaluated(wi);
  const Vec3d color = wi.z > 0 ? Vec3d(glass_share_) : transmitted_;
  const double passed = through(from_wo_.below_sheen, passage(std::abs(wi.z)).below_sheen);
  return specular(wi, color * (passed * probability), probability_.glass * probability);
}

}  // namespace tracer
