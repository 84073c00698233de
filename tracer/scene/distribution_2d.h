// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tracer/base/vectors.h"

namespace tracer {

/// Cells of a grid, to be picked by weight: a row, then a column of it. Numbers that are close pick
/// cells that are close, so that well spread numbers stay so.
class Distribution2d {
 public:
  struct Pick {
    int column = 0;
    int row = 0;
    Vec2d place{};           // in the cell, uniform in [0, 1)^2
    double probability = 0;  // of the cell
  };

  Distribution2d() = default;
  /// `weights` row by row, width * height of them, none negative, their sum finite and above 0.
  Distribution2d(int width, int height, std::span<const double> weights);

  /// u uniform in [0, 1)^2. Cells of weight 0 are never picked.
  Pick pick(const Vec2d& u) const;
  double probability(int column, int row) const;

 private:
  std::span<const double> columns_of(int row) const {
    return {&columns_[static_cast<size_t>(row) * (width_ + 1)], static_cast<size_t>(width_) + 1};
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<double> rows_;     // cumulative, from 0 to 1
  std::vector<double> columns_;  // the same of each row
};

}  // namespace tracer
