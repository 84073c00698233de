// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "tracer/base/fields.h"
#include "tracer/base/random.h"
#include "tracer/base/vectors.h"
#include "tracer/render/owen_sobol.h"

namespace tracer {

/// How the random numbers of a pixel's samples, and those of its neighbours, depend on each other.
enum class SamplerKind { sobol, independent };

/// The first is the default.
std::span<const Choice<SamplerKind>> samplers();

/// The random numbers of one sample of one pixel: each a function of (pixel, sample, dimension,
/// seed) alone, so no order of tiles or threads changes a picture.
class Sampler {
 public:
  /// Of pixel 0, for arrays.
  Sampler() = default;
  /// Pixels are 0 to 65535 along x and y.
  Sampler(SamplerKind kind, Vec2i pixel, uint32_t sample, uint32_t seed)
      : Sampler(static_cast<uint32_t>(pixel.y) << 16 | static_cast<uint32_t>(pixel.x), sample,
                seed) {
    kind_ = kind;
    if (kind != SamplerKind::sobol) return;
    sobol_ = {static_cast<uint32_t>(pixel.x), static_cast<uint32_t>(pixel.y), sample, seed};
  }
  /// Independent numbers.
  Sampler(uint32_t pixel, uint32_t sample, uint32_t seed)
      : pixel_(pixel), sample_(sample), seed_(seed) {}

  /// Uniform in [0, 1).
  double next() {
    const uint32_t dimension = dimension_++;
    if (kind_ == SamplerKind::sobol) return to_unit_float(sobol_.number(dimension));
    return to_unit_float(hash_words({pixel_, sample_, dimension, seed_}).x);
  }
  /// Uniform in [0, 1)^2, one dimension.
  Vec2d next_2d() {
    const uint32_t dimension = dimension_++;
    if (kind_ == SamplerKind::sobol) {
      const DigitPair point = sobol_.pair(dimension);
      return {to_unit_float(point.x), to_unit_float(point.y)};
    }
    const Words4 words = hash_words({pixel_, sample_, dimension, seed_});
    return {to_unit_float(words.x), to_unit_float(words.y)};
  }

 private:
  SamplerKind kind_ = SamplerKind::independent;
  uint32_t pixel_ = 0;
  uint32_t sample_ = 0;
  uint32_t seed_ = 0;
  uint32_t dimension_ = 0;
  OwenSobolSample sobol_;
};

}  // namespace tracer
