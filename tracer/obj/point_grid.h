// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tracer/base/vectors.h"

namespace tracer {

/// Points of the plane by square cells, about one a cell.
class PointGrid {
 public:
  /// Holds the points that `indices` names.
  void build(std::span<const Vec2d> points, std::span<const uint32_t> indices);

  /// Calls f(index) for the points in cells that meet the triangle until it returns true; counts
  /// down `steps` for each cell and point looked at. Returns whether f did.
  template <class F>
  bool any_in_triangle(const Vec2d& a, const Vec2d& b, const Vec2d& c, int64_t& steps,
                       F&& f) const {
    if (indices_.empty()) return false;
    const Vec2d corners[3] = {to_cells(a), to_cells(b), to_cells(c)};
    const int last_row = index_of(std::max({corners[0].y, corners[1].y, corners[2].y}));
    for (int row = index_of(std::min({corners[0].y, corners[1].y, corners[2].y})); row <= last_row;
         ++row) {
      const auto [first, last] = columns_in_row(corners, row);
      const size_t row_begin = static_cast<size_t>(row) * size_;
      for (size_t cell = row_begin + first; cell <= row_begin + last; ++cell) {
        steps -= 1 + begins_[cell + 1] - begins_[cell];
        for (uint32_t i = begins_[cell]; i < begins_[cell + 1]; ++i) {
          if (f(indices_[i])) return true;
        }
      }
    }
    return false;
  }

 private:
  Vec2d to_cells(const Vec2d& point) const { return (point - min_) * scale_; }
  int index_of(double cell) const {
    return static_cast<int>(std::clamp(cell, 0.0, static_cast<double>(size_ - 1)));
  }
  size_t cell_index(const Vec2d& point) const {
    const Vec2d cell = to_cells(point);
    return static_cast<size_t>(index_of(cell.y)) * size_ + index_of(cell.x);
  }
  /// The first and last column of a row that the triangle, in cells, may meet.
  std::pair<int, int> columns_in_row(const Vec2d (&corners)[3], int row) const;

  int size_ = 1;  // cells along an axis
  Vec2d min_{};
  Vec2d scale_{};  // cells a unit
  std::vector<uint32_t> begins_;
  std::vector<uint32_t> indices_;
};

}  // namespace tracer
