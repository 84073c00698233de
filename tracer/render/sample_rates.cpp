// SPDX-License-Identifier: MIT
#include "tracer/render/sample_rates.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracer/render/film_error.h"

namespace tracer {
namespace {

// However quiet the pixels seem that decide.
constexpr float least_rate = 1.0f / 16;
// A few squares may seem far noisier than all others, after one bright sample.
constexpr double part_below_full_rate = 0.98;

struct VarianceSum {
  double variance = 0;  // of one sample, relative
  double count = 0;     // of pixels

  void add(const VarianceSum& other, double weight) {
    variance += weight * other.variance;
    count += weight * other.count;
  }
  double deviation() const { return count > 0 ? std::sqrt(variance / count) : 0; }
};

}  // namespace

std::span<const Choice<Allocation>> allocations() {
  static constexpr Choice<Allocation> table[] = {
      {Allocation::even, "even", "Even", "Every pixel takes the same number of samples."},
      {Allocation::adaptive, "adaptive", "Where the error is",
       "Pixels take samples by how noisy their neighbours have turned out."},
  };
  return table;
}

SampleRates::SampleRates(const Film& film) {
  const Vec2i size_px = film.size_px();
  squares_a_row_ = (size_px.x + square_side - 1) / square_side;
  const int rows = (size_px.y + square_side - 1) / square_side;
  std::vector<VarianceSum> shown(2 * static_cast<size_t>(squares_a_row_) * rows);
  for (int y = 0; y < size_px.y; ++y) {
    for (int x = 0; x < size_px.x; ++x) {
      shown[index(x, y)].add({pixel_error(film, x, y) * film.sample_count(x, y), 1}, 1);
    }
  }
  rates_.resize(shown.size());
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < squares_a_row_; ++column) {
      for (size_t color : {size_t{0}, size_t{1}}) {
        // The square itself weighs four times what those at its corners do.
        VarianceSum others;
        for (int y = std::max(row - 1, 0); y < std::min(row + 2, rows); ++y) {
          for (int x = std::max(column - 1, 0); x < std::min(column + 2, squares_a_row_); ++x) {
            const int weight = (2 - std::abs(y - row)) * (2 - std::abs(x - column));
            others.add(shown[2 * (static_cast<size_t>(y) * squares_a_row_ + x) + 1 - color],
                       weight);
          }
        }
        rates_[2 * (static_cast<size_t>(row) * squares_a_row_ + column) + color] =
            static_cast<float>(others.deviation());
      }
    }
  }
  std::vector<float> sorted = rates_;
  const auto full = sorted.begin() + static_cast<ptrdiff_t>(part_below_full_rate * sorted.size());
  std::nth_element(sorted.begin(), full, sorted.end());
  for (float& rate : rates_) rate = *full > 0 ? std::clamp(rate / *full, least_rate, 1.0f) : 1;
}

}  // namespace tracer
