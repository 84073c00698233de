// SPDX-License-Identifier: MIT
// Where samples go: docs/sampling.md says why they are spread like this.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tracer/base/fields.h"

namespace tracer {

class Film;

enum class Allocation { even, adaptive };

/// The first is the default.
std::span<const Choice<Allocation>> allocations();

/// How many of the samples that the noisiest pixels take each pixel takes: in (0, 1], and 1
/// throughout when new.
///
/// Chosen by what other pixels have shown, never by the pixel's own samples: a pixel that has
/// missed what is bright by chance would stop early, and the picture would be too dark. Squares of
/// 8x8 pixels are chessboards, whose black pixels decide for the white ones and the other way
/// round.
class SampleRates {
 public:
  SampleRates() = default;
  /// In proportion to the deviation of one sample, which makes the film's error the least for the
  /// samples spent [Neyman 1934]. Every pixel of the film has at least 2 samples.
  explicit SampleRates(const Film& film);

  bool are_even() const { return rates_.empty(); }
  float rate(int x, int y) const { return rates_.empty() ? 1 : rates_[index(x, y)]; }

 private:
  static constexpr int square_side = 8;

  size_t index(int x, int y) const {
    const size_t square = static_cast<size_t>(y / square_side) * squares_a_row_ + x / square_side;
    return 2 * square + static_cast<size_t>((x ^ y) & 1);
  }

  int squares_a_row_ = 0;
  std::vector<float> rates_;  // of each square's two colours
};

}  // namespace tracer
