// SPDX-License-Identifier: MIT
// Owen-scrambled Sobol points, two dimensions at a time, arranged so that the errors of
// neighbouring pixels cancel: docs/sampling.md says why it is made like this.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace tracer {

constexpr uint32_t reverse_bits(uint32_t word) {
  word = __builtin_bswap32(word);
  word = (word & 0x0f0f0f0fu) << 4 | (word >> 4 & 0x0f0f0f0fu);
  word = (word & 0x33333333u) << 2 | (word >> 2 & 0x33333333u);
  return (word & 0x55555555u) << 1 | (word >> 1 & 0x55555555u);
}

/// Flips each bit or not, by chance that depends on `seed` and the lower bits: Owen's nested
/// scrambling where the lowest bit is the most significant. [Laine 2011] [Vegdahl 2021]
constexpr uint32_t scramble_upwards(uint32_t word, uint32_t seed) {
  word ^= word * 0x3d20adeau;
  word += seed;
  word *= seed >> 16 | 1;
  word ^= word * 0x05526c56u;
  word ^= word * 0x53a22864u;
  return word;
}

/// Well-mixed 64 bits from 64, one to one [Steele 2014].
constexpr uint64_t mix_bits(uint64_t bits) {
  bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ bits >> 27) * 0x94d049bb133111ebu;
  return bits ^ bits >> 31;
}

/// Two numbers of 32 binary digits, the first digit in the lowest bit.
struct DigitPair {
  uint32_t x, y;
};

/// Sobol's point of an index in the first two dimensions. With the index as a polynomial p(t) over
/// the field of two elements, y is p(1 + t). [Sobol 1967]
constexpr DigitPair sobol_digits(uint32_t index) {
  uint32_t y = index;
  y ^= (y & 0xffff0000u) >> 16;
  y ^= (y & 0xff00ff00u) >> 8;
  y ^= (y & 0xf0f0f0f0u) >> 4;
  y ^= (y & 0xccccccccu) >> 2;
  y ^= (y & 0xaaaaaaaau) >> 1;
  return {index, y};
}

/// Pixels share one scrambled sequence in squares of 16 x 16.
inline constexpr int pixel_block_levels = 4;
inline constexpr uint32_t pixel_block_side = 1u << pixel_block_levels;
inline constexpr uint32_t pixel_block_size = pixel_block_side * pixel_block_side;

/// The Morton code of a pixel's place in its block, the most significant bit lowest.
constexpr uint32_t place_in_pixel_block(uint32_t x, uint32_t y) {
  uint32_t place = 0;
  for (uint32_t bit = 0; bit < pixel_block_levels; ++bit) {
    place = place << 2 | (x >> bit & 1) << 1 | (y >> bit & 1);
  }
  return place;
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

/// A place in an order of [0, mask], mask + 1 a power of two, that `key` picks.
constexpr uint32_t shuffle(uint32_t i, uint32_t mask, uint32_t key) {
  const int half = (std::bit_width(mask) + 1) / 2;
  for (int round = 0; round < 3; ++round) {
    key = key * 0x915f77f5u + 0x2c1b3c6du;
    i = (i ^ key >> 16) * (key >> 3 | 1) & mask;
    i ^= i >> half;
  }
  return i;
}

/// The points of one sample of one pixel: in each dimension Sobol's first two, in an order and with
/// a scrambling of their own, which the pixels of a block share. [Burley 2020] [Ahmed 2020]
class OwenSobolSample {
 public:
  OwenSobolSample() = default;
  OwenSobolSample(uint32_t pixel_x, uint32_t pixel_y, uint32_t sample, uint32_t seed)
      : block_(mix_bits(mix_bits(seed + 0x9e3779b97f4a7c15u) ^
                        (static_cast<uint64_t>(pixel_y / pixel_block_side) << 32 |
                         pixel_x / pixel_block_side))),
        sample_(sample),
        below_leading_bit_(std::max(1u, std::bit_floor(sample)) - 1),
        within_quarter_(below_leading_bit_ >> 2),
        octave_(std::bit_width(below_leading_bit_)),
        quarter_bit_(static_cast<uint32_t>(std::bit_width(within_quarter_))),
        quarter_(sample >> quarter_bit_ & below_leading_bit_ >> quarter_bit_),
        place_(place_in_pixel_block(pixel_x % pixel_block_side, pixel_y % pixel_block_side)) {
    const uint64_t quarter = sample & ~within_quarter_;
    order_ = static_cast<uint32_t>(mix_bits(block_ + (quarter << 8 | place_)));
  }

  /// 32 bits, the first digit in the highest.
  uint32_t number(uint32_t dimension) const {
    const Seeds seeds = seeds_of(dimension);
    return reverse_bits(scramble_upwards(index(seeds) ^ shift(seeds).x, seeds.x));
  }
  DigitPair pair(uint32_t dimension) const {
    const Seeds seeds = seeds_of(dimension);
    const DigitPair point = sobol_digits(index(seeds));
    const DigitPair by = shift(seeds);
    return {reverse_bits(scramble_upwards(point.x ^ by.x, seeds.x)),
            reverse_bits(scramble_upwards(point.y ^ by.y, seeds.y))};
  }

 private:
  struct Seeds {
    uint32_t index, place, x, y;
  };

  Seeds seeds_of(uint32_t dimension) const {
    const uint64_t first = mix_bits(block_ + dimension * 0x9e3779b97f4a7c15u);
    const uint64_t second = first * 0xd1342543de82ef95u;
    return {static_cast<uint32_t>(second >> 32), static_cast<uint32_t>(second >> 8),
            static_cast<uint32_t>(first >> 32), static_cast<uint32_t>(first)};
  }

  // The samples [2^k, 2^(k+1)) change places, so that prefixes stay nets: quarters of them with
  // each other, nested, and within a quarter all of them, each pixel's in its own way.
  uint32_t index(const Seeds& seeds) const {
    // Other random bits for each octave.
    const uint32_t random = std::rotr(seeds.index, 3 * octave_);
    const uint32_t flips = (random & 2) | (random >> (quarter_ & 2) & 1);
    const uint32_t quarter = ((quarter_ ^ flips) << quarter_bit_) & below_leading_bit_;
    const uint32_t within =
        shuffle(sample_ & within_quarter_, within_quarter_, (order_ ^ seeds.index) * 0x85ebca6bu);
    return (sample_ & ~below_leading_bit_) | quarter | within;
  }

  const DigitPair& shift(const Seeds& seeds) const {
    return pixel_shifts[scramble_upwards(place_, seeds.place) % pixel_block_size];
  }

  uint64_t block_ = 0;
  uint32_t sample_ = 0;
  uint32_t below_leading_bit_ = 0;  // masks of the sample's bits
  uint32_t within_quarter_ = 0;
  int octave_ = 0;
  uint32_t quarter_bit_ = 0;  // the lowest of the two that say which quarter
  uint32_t quarter_ = 0;
  uint32_t place_ = 0;
  uint32_t order_ = 0;
};

}  // namespace tracer
