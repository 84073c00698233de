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
      : Sampler(number_of(pixel), sample, seed) {
    if (kind == SamplerKind::sobol)
      *this = Sampler(pixel, sample, seed, square_of(pixel, sample, seed));
  }
  /// Independent numbers.
  Sampler(uint32_t pixel, uint32_t sample, uint32_t seed)
      : pixel_(pixel), sample_(sample), seed_(seed) {}
  /// Sobol numbers of a pixel in the square of that sample and seed.
  Sampler(Vec2i pixel, uint32_t sample, uint32_t seed, const OwenSobolSquare& square)
      : kind_(SamplerKind::sobol),
        pixel_(number_of(pixel)),
        sample_(sample),
        seed_(seed),
        sobol_(square, static_cast<uint32_t>(pixel.x), static_cast<uint32_t>(pixel.y)) {}

  static OwenSobolSquare square_of(Vec2i pixel, uint32_t sample, uint32_t seed) {
    return {static_cast<uint32_t>(pixel.x), static_cast<uint32_t>(pixel.y), sample, seed};
  }

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

  SamplerKind kind() const { return kind_; }
  /// How many numbers and pairs have been asked for.
  uint32_t dimension() const { return dimension_; }
  void skip_to(uint32_t dimension) { dimension_ = dimension; }
  /// What Sobol numbers are made of.
  const OwenSobolSample& sobol() const { return sobol_; }

 private:
  static uint32_t number_of(Vec2i pixel) {
    return static_cast<uint32_t>(pixel.y) << 16 | static_cast<uint32_t>(pixel.x);
  }

  SamplerKind kind_ = SamplerKind::independent;
  uint32_t pixel_ = 0;
  uint32_t sample_ = 0;
  uint32_t seed_ = 0;
  uint32_t dimension_ = 0;
  OwenSobolSample sobol_;
};

/// Makes samplers of pixels near each other: what a square of them shares is worked out once.
class SamplerSource {
 public:
  SamplerSource(SamplerKind kind, uint32_t seed) : kind_(kind), seed_(seed) {}

  Sampler sampler(Vec2i pixel, uint32_t sample) {
    if (kind_ != SamplerKind::sobol) return {kind_, pixel, sample, seed_};
    const Vec2i corner = pixel / static_cast<int>(pixel_block_side);
    if (corner != corner_ || sample != sample_) {
      corner_ = corner;
      sample_ = sample;
      square_ = Sampler::square_of(pixel, sample, seed_);
    }
    return {pixel, sample, seed_, square_};
  }

 private:
  SamplerKind kind_;
  uint32_t seed_;
  Vec2i corner_{-1, -1};
  uint32_t sample_ = 0;
  OwenSobolSquare square_;
};

}  // namespace tracer
