// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>

#include "tracer/base/random.h"
#include "tracer/base/vectors.h"

namespace tracer {

/// The same sequence for the same seed, everywhere.
class RandomSource {
 public:
  /// Streams of one seed have nothing in common.
  explicit RandomSource(uint32_t seed, uint64_t stream = 0)
      : seed_(seed),
        stream_low_(0x9e3779b9u ^ static_cast<uint32_t>(stream)),
        stream_high_(7u + static_cast<uint32_t>(stream >> 32)) {}

  uint32_t word() { return hash_words({seed_, ++count_, stream_low_, stream_high_}).x; }
  float unit() { return to_unit_float(word()); }
  float between(float low, float high) { return low + (high - low) * unit(); }
  int integer(int low, int high) {
    return low + static_cast<int>(word() % static_cast<uint32_t>(high - low + 1));
  }
  Vec3f vector(float low, float high) {
    const float x = between(low, high);
    const float y = between(low, high);
    return {x, y, between(low, high)};
  }
  Vec3f lattice(int low, int high) {
    const int x = integer(low, high);
    const int y = integer(low, high);
    return {x, y, integer(low, high)};
  }
  /// Any bit pattern of a finite float, zeros and denormals included.
  float finite_bits() {
    const float value = std::bit_cast<float>(word());
    return std::isfinite(value) ? value : 0;
  }

 private:
  uint32_t seed_;
  uint32_t stream_low_;
  uint32_t stream_high_;
  uint32_t count_ = 0;
};

}  // namespace tracer
