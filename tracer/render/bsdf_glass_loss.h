// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tracer/base/vectors.h"

namespace tracer {

/// The side of a surface: outside is where its right-handed normal points.
enum class Side : uint8_t { outside, inside };

inline Side other_side(Side side) {
  return side == Side::outside ? Side::inside : Side::outside;
}

/// Of light that leaves the rough surface of clear matter along a direction, the share that its
/// facets hold back when each ray meets but one: tabulated. [Walter 2007]
class GlassLossTables {
 public:
  GlassLossTables();

  /// Where an alpha in [smoothest_alpha, 1] and an index of refraction are found; one below 1.1 or
  /// above 3 counts as these.
  struct Place {
    double alpha = 1;
    size_t first_alpha = 0;
    double next_alpha = 0;
    size_t first_ior = 0;
    double next_ior = 0;
  };
  static Place place(double alpha, double ior);

  double loss(const Place& place, Side side, double cosine) const;
  /// Over the cosine-weighted hemisphere.
  double mean_loss(const Place& place, Side side) const;

 private:
  static constexpr size_t ior_count = 12;
  static constexpr size_t alpha_count = 48;
  static constexpr size_t cosine_count = 48;

  void fill(Side side);

  // By side: [ior][alpha][cosine] and [ior][alpha].
  std::array<std::vector<float>, 2> losses_;
  std::array<std::vector<float>, 2> means_;
};

/// Made when first asked for, in some 60 ms.
const GlassLossTables& glass_loss_tables();

}  // namespace tracer
