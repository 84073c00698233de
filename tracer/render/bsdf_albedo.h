// SPDX-License-Identifier: MIT
// How much light layers reflect by themselves, tabulated: what is left for those beneath.
#pragma once

#include <array>
#include <vector>

#include "tracer/base/vectors.h"

namespace tracer {

/// Of light along one direction, the share that GGX facets reflect once and let out, for mirrors
/// (`full`) and for a reflectance of (1 - cosine)^5 (`grazing`).
struct GgxAlbedo {
  double full = 1;
  double grazing = 0;
};

/// What a layer lets through as a sum of 1, full and grazing times these, or of 1 and sheen.
using LayerWeights = std::array<double, 3>;

/// Interpolated tables of isotropic layers. Cosines in (0, 1], alphas in [smoothest_alpha, 1].
class AlbedoTables {
 public:
  AlbedoTables();

  /// Where an alpha is found.
  struct Row {
    double alpha = 1;
    size_t first = 0;
    double next_weight = 0;
  };
  Row row(double alpha) const;

  GgxAlbedo ggx(const Row& row, double cosine) const;
  /// 1 - full, averaged over the cosine-weighted hemisphere.
  double mean_loss(const Row& row) const;
  /// Of a reflectance of (1 - cosine to the half vector)^5, not divided by pi.
  double sheen(double cosine) const;

  /// The cosine-weighted mean of the product of what three layers let through.
  double mean_product(const LayerWeights& sheen, const LayerWeights& coat, const Row& coat_row,
                      const LayerWeights& base, const Row& base_row) const;

 private:
  static constexpr size_t cosine_count = 320;
  static constexpr size_t alpha_count = 192;
  static constexpr size_t mean_count = 24;
  static constexpr size_t sheen_count = 64;
  // [sheen][coat][base], each 1 and then the layer's own shares.
  using Moments = std::array<double, 2 * 3 * 3>;

  void fill_ggx();
  void fill_sheen();
  void fill_means();

  std::vector<Vec2f> ggx_;        // full and grazing, [alpha][cosine]
  std::vector<double> loss_;      // over alpha^2, [alpha]
  std::vector<double> sheen_;     // by the root of the cosine
  std::vector<Moments> moments_;  // [alpha of the coat][alpha of the base]
};

/// Made when first asked for, in some 10 ms.
const AlbedoTables& albedo_tables();

}  // namespace tracer
