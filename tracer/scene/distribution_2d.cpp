// SPDX-License-Identifier: MIT
#include "tracer/scene/distribution_2d.h"

#include <algorithm>
#include <cassert>

#include "tracer/base/parallel.h"

namespace tracer {
namespace {

/// Divides by the last, unless that is 0.
void normalise(std::span<double> cumulative) {
  const double total = cumulative.back();
  if (!(total > 0)) return;
  for (double& value : cumulative) value /= total;
}

struct CellPick {
  size_t cell = 0;
  double place = 0;
};
/// The cell in which u falls, among those of width above 0, and where in it.
CellPick pick_cell(std::span<const double> cumulative, double u) {
  const auto above = std::upper_bound(cumulative.begin() + 1, cumulative.end() - 1, u);
  const auto cell = static_cast<size_t>(above - cumulative.begin()) - 1;
  const double size = cumulative[cell + 1] - cumulative[cell];
  const double place = size > 0 ? (u - cumulative[cell]) / size : 0;
  return {cell, std::min(place, 1 - 0x1p-53)};
}

}  // namespace

Distribution2d::Distribution2d(int width, int height, std::span<const double> weights)
    : width_(width),
      height_(height),
      rows_(static_cast<size_t>(height) + 1),
      columns_(static_cast<size_t>(height) * (width + 1)) {
  assert(weights.size() == static_cast<size_t>(width) * height);
  std::vector<double> row_sums(height);
  parallel_for_ranges(0, static_cast<size_t>(height), 64, [&](size_t begin, size_t end) {
    for (size_t row = begin; row < end; ++row) {
      double* cumulative = &columns_[row * (width + 1)];
      for (int column = 0; column < width; ++column) {
        cumulative[column + 1] = cumulative[column] + weights[row * width + column];
      }
      row_sums[row] = cumulative[width];
      normalise({cumulative, static_cast<size_t>(width) + 1});
    }
  });
  for (int row = 0; row < height; ++row) rows_[row + 1] = rows_[row] + row_sums[row];
  normalise(rows_);
}

Distribution2d::Pick Distribution2d::pick(const Vec2d& u) const {
  const CellPick row = pick_cell(rows_, u.y);
  const CellPick column = pick_cell(columns_of(static_cast<int>(row.cell)), u.x);
  const int x = static_cast<int>(column.cell);
  const int y = static_cast<int>(row.cell);
  return {x, y, {column.place, row.place}, probability(x, y)};
}

double Distribution2d::probability(int column, int row) const {
  const std::span<const double> columns = columns_of(row);
  return (rows_[row + 1] - rows_[row]) * (columns[column + 1] - columns[column]);
}

}  // namespace tracer
