// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "tracer/base/random.h"
#include "tracer/base/vectors.h"

namespace tracer {

/// The random numbers of one sample of one pixel: each a function of (pixel, sample, dimension,
/// seed) alone, so no order of tiles or threads changes a picture.
class Sampler {
 public:
  /// Of pixel 0, for arrays.
  Sampler() = default;
  Sampler(uint32_t pixel, uint32_t sample, uint32_t seed)
      : pixel_(pixel), sample_(sample), seed_(seed) {}

  /// Uniform in [0, 1).
  double next() { return to_unit_float(hash_words({pixel_, sample_, dimension_++, seed_}).x); }
  /// Uniform in [0, 1)^2, one dimension.
  Vec2d next_2d() {
    const Words4 words = hash_words({pixel_, sample_, dimension_++, seed_});
    return {to_unit_float(words.x), to_unit_float(words.y)};
  }

 private:
  uint32_t pixel_ = 0;
  uint32_t sample_ = 0;
  uint32_t seed_ = 0;
  uint32_t dimension_ = 0;
};

}  // namespace tracer
