// SPDX-License-Identifier: MIT
#include "tracer/obj/point_grid.h"

namespace tracer {
namespace {

// Rows and columns overlap by more than all rounding in here.
constexpr double overlap = 1.0 / 64;

double cells_a_unit(double extent, int cell_count) {
  const double scale = cell_count / extent;
  return std::isfinite(scale) ? scale : 0;
}

}  // namespace

void PointGrid::build(std::span<const Vec2d> points, std::span<const uint32_t> indices) {
  indices_.assign(indices.size(), 0);
  if (indices.empty()) return;
  size_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(indices.size()))));
  Vec2d max = min_ = points[indices[0]];
  for (const uint32_t index : indices) {
    min_ = glm::min(min_, points[index]);
    max = glm::max(max, points[index]);
  }
  scale_ = {cells_a_unit(max.x - min_.x, size_), cells_a_unit(max.y - min_.y, size_)};

  begins_.assign(static_cast<size_t>(size_) * size_ + 2, 0);
  for (const uint32_t index : indices) ++begins_[cell_index(points[index]) + 2];
  for (size_t i = 2; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  for (const uint32_t index : indices) indices_[begins_[cell_index(points[index]) + 1]++] = index;
}

std::pair<int, int> PointGrid::columns_in_row(const Vec2d (&corners)[3], int row) const {
  const double low = row - overlap;
  const double high = row + 1 + overlap;
  double left = size_;
  double right = 0;
  for (int i = 0; i < 3; ++i) {
    Vec2d from = corners[i];
    Vec2d to = corners[(i + 1) % 3];
    if (from.y > to.y) std::swap(from, to);
    if (to.y < low || from.y > high) continue;
    const Vec2d along = to - from;
    const double begin = from.y < low ? (low - from.y) / along.y : 0;
    const double end = to.y > high ? (high - from.y) / along.y : 1;
    const double x0 = from.x + begin * along.x;
    const double x1 = from.x + end * along.x;
    left = std::min({left, x0, x1});
    right = std::max({right, x0, x1});
  }
  return {index_of(left - overlap), index_of(right + overlap)};
}

}  // namespace tracer
