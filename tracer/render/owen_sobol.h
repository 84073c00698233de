// SPDX-License-Identifier: MIT
// Owen-scrambled Sobol points, two dimensions at a time, arranged so that the errors of
// neighbouring pixels cancel: docs/sampling.md says why it is made like this.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace tracer {

/// Of one dimension, in a square of pixels.
struct SobolSeeds {
  uint32_t index, place, x, y;
};

#include "tracer/render/owen_sobol_words-inl.h"

/// Well-mixed 64 bits from 64, one to one [Steele 2014].
constexpr uint64_t mix_bits(uint64_t bits) {
  bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ bits >> 27) * 0x94d049bb133111ebu;
  return bits ^ bits >> 31;
}

/// Two numbers of 32 binary digits, the first digit in the lowest bit.
using DigitPair = WordPair<uint32_t>;

/// Pixels share one scrambled sequence in squares of 16 x 16.
inline constexpr int pixel_block_levels = 4;
inline constexpr uint32_t pixel_block_side = 1u << pixel_block_levels;
inline constexpr uint32_t pixel_block_size = pixel_block_side * pixel_block_side;

/// The Morton codes of pixels' places in their square, the most significant bit lowest.
constexpr std::array<uint8_t, pixel_block_size> make_places() {
  std::array<uint8_t, pixel_block_size> places{};
  for (uint32_t i = 0; i < pixel_block_size; ++i) {
    for (uint32_t bit = 0; bit < pixel_block_levels; ++bit) {
      const uint32_t x = i >> bit & 1, y = i >> (bit + pixel_block_levels) & 1;
      places[i] = static_cast<uint8_t>(places[i] << 2 | x << 1 | y);
    }
  }
  return places;
}
inline constexpr std::array<uint8_t, pixel_block_size> pixel_places = make_places();

constexpr uint32_t place_in_pixel_block(uint32_t x, uint32_t y) {
  return pixel_places[y % pixel_block_side * pixel_block_side + x % pixel_block_side];
}

/// The power series of series / (1 + t + t^2).
constexpr uint32_t divide_by_1_t_t2(uint32_t series) {
  uint32_t quotient = 0;
  for (int k = 0; k < 32; ++k) {
    const uint32_t carried = (quotient << 1 ^ quotient << 2) >> k & 1;
    quotient |= ((series >> k & 1) ^ carried) << k;
  }
  return quotient;
}

/// What is added, digit by digit, to the points of the pixel at each place: q(t) / (1 + t + t^2)^4
/// with the degree of q below 8, expanded at t = 0 and t = 1. Points of the first 2^m indices and
/// of an aligned square of 4^l pixels are then a (0, m + 2 l, 2)-net: a difference that vanishes to
/// orders a at 0 and b at 1, a + b = m + 2 l, has more zeros than its degree allows.
constexpr std::array<DigitPair, pixel_block_size> make_pixel_shifts() {
  std::array<DigitPair, pixel_block_size> shifts{};
  uint32_t power = 1;  // of 1 / (1 + t + t^2), which is the same at 0 and 1
  for (int bit = 2 * pixel_block_levels - 2; bit >= 0; bit -= 2) {
    power = divide_by_1_t_t2(power);
    const DigitPair steps[] = {{power << 1, power ^ power << 1}, {power, power}};
    for (uint32_t place = 0; place < pixel_block_size; ++place) {
      for (int side = 0; side < 2; ++side) {
        if ((place >> (bit + side) & 1) == 0) continue;
        shifts[place].x ^= steps[side].x;
        shifts[place].y ^= steps[side].y;
      }
    }
  }
  return shifts;
}
inline constexpr std::array<DigitPair, pixel_block_size> pixel_shifts = make_pixel_shifts();

/// What the samples of one index have in common in a square of pixels.
class OwenSobolSquare {
 public:
  OwenSobolSquare() = default;
  OwenSobolSquare(uint32_t pixel_x, uint32_t pixel_y, uint32_t sample, uint32_t seed)
      : square_(mix_bits(mix_bits(seed + 0x9e3779b97f4a7c15u) ^
                         (static_cast<uint64_t>(pixel_y / pixel_block_side) << 32 |
                          pixel_x / pixel_block_side))),
        sample_(sample),
        below_leading_bit_(std::max(1u, std::bit_floor(sample)) - 1),
        within_quarter_(below_leading_bit_ >> 2),
        octave_(std::bit_width(below_leading_bit_)),
        quarter_bit_(static_cast<uint32_t>(std::bit_width(within_quarter_))),
        quarter_(sample >> quarter_bit_ & below_leading_bit_ >> quarter_bit_) {}

  friend bool operator==(const OwenSobolSquare& a, const OwenSobolSquare& b) {
    return a.square_ == b.square_ && a.sample_ == b.sample_;
  }

  /// Of the order in which the pixel at a place of the square takes its samples.
  uint32_t order(uint32_t place) const {
    const uint64_t quarter = sample_ & ~within_quarter_;
    return static_cast<uint32_t>(mix_bits(square_ + (quarter << 8 | place)));
  }
  SobolSeeds seeds(uint32_t dimension) const {
    const uint64_t first = mix_bits(square_ + dimension * 0x9e3779b97f4a7c15u);
    const uint64_t second = first * 0xd1342543de82ef95u;
    return {static_cast<uint32_t>(second >> 32), static_cast<uint32_t>(second >> 8),
            static_cast<uint32_t>(first >> 32), static_cast<uint32_t>(first)};
  }
  /// The sample's index in a dimension, before the bits within the mask change places. The samples
  /// [2^k, 2^(k+1)) do, so that prefixes stay nets: quarters of them with each other, nested, and
  /// within a quarter all of them, each pixel's in its own way.
  uint32_t index(const SobolSeeds& seeds) const {
    // Other random bits for each octave.
    const uint32_t random = std::rotr(seeds.index, 3 * octave_);
    const uint32_t flips = (random & 2) | (random >> (quarter_ & 2) & 1);
    const uint32_t quarter = ((quarter_ ^ flips) << quarter_bit_) & below_leading_bit_;
    return (sample_ & ~below_leading_bit_) | quarter | (sample_ & within_quarter_);
  }
  uint32_t mask() const { return within_quarter_; }

 private:
  uint64_t square_ = 0;
  uint32_t sample_ = 0;
  uint32_t below_leading_bit_ = 0;  // masks of the sample's bits
  uint32_t within_quarter_ = 0;
  int octave_ = 0;
  uint32_t quarter_bit_ = 0;  // the lowest of the two that say which quarter
  uint32_t quarter_ = 0;
};

/// The points of one sample of one pixel: in each dimension Sobol's first two, in an order and with
/// a scrambling of their own, which the pixels of a block share. [Burley 2020] [Ahmed 2020]
class OwenSobolSample {
 public:
  OwenSobolSample() = default;
  OwenSobolSample(uint32_t pixel_x, uint32_t pixel_y, uint32_t sample, uint32_t seed)
      : OwenSobolSample(OwenSobolSquare(pixel_x, pixel_y, sample, seed), pixel_x, pixel_y) {}
  /// Of a pixel in the square.
  OwenSobolSample(const OwenSobolSquare& square, uint32_t pixel_x, uint32_t pixel_y)
      : square_(square),
        place_(place_in_pixel_block(pixel_x, pixel_y)),
        order_(square_.order(place_)) {}

  const OwenSobolSquare& square() const { return square_; }
  uint32_t place() const { return place_; }
  uint32_t order() const { return order_; }

  /// 32 bits, the first digit in the highest.
  uint32_t number(uint32_t dimension) const { return pair(dimension).x; }
  DigitPair pair(uint32_t dimension) const {
    const SobolSeeds seeds = square_.seeds(dimension);
    const DigitPair& shift = pixel_shifts[scramble_upwards(place_, seeds.place) % pixel_block_size];
    return scrambled_point(square_.index(seeds), square_.mask(), order_, shift, seeds);
  }

 private:
  OwenSobolSquare square_;
  uint32_t place_ = 0;
  uint32_t order_ = 0;
};

}  // namespace tracer
