// SPDX-License-Identifier: MIT
#include "tracer/bvh/sah_2d.h"

#include <algorithm>
#include <iterator>

namespace tracer {
namespace {

size_t count_below(const std::vector<double>& sorted, double d) {
  return static_cast<size_t>(std::ranges::lower_bound(sorted, d) - sorted.begin());
}

size_t count_above(const std::vector<double>& sorted, double d) {
  return static_cast<size_t>(sorted.end() - std::ranges::upper_bound(sorted, d));
}

size_t count_at(const std::vector<double>& sorted, double d) {
  return sorted.size() - count_below(sorted, d) - count_above(sorted, d);
}

}  // namespace

SahNode2d::SahNode2d(const Rectangle& box, std::span<const XInterval> triangles,
                     const SahCosts& costs)
    : box_(box), costs_(costs) {
  for (const XInterval& triangle : triangles) {
    if (!(triangle.max >= box.x0 && triangle.min <= box.x1)) continue;
    starts_.push_back(std::max(triangle.min, box.x0));
    ends_.push_back(std::min(triangle.max, box.x1));
    if (starts_.back() == ends_.back()) flats_.push_back(starts_.back());
  }
  std::ranges::sort(starts_);
  std::ranges::sort(ends_);
  std::ranges::sort(flats_);
  std::ranges::set_union(starts_, ends_, std::back_inserter(candidates_));
  candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
}

size_t SahNode2d::left_count(double d) const {
  return count_below(starts_, d) + flat_left_count(d);
}

size_t SahNode2d::right_count(double d) const {
  return count_above(ends_, d) + flat_right_count(d);
}

size_t SahNode2d::flat_left_count(double d) const {
  return d - box_.x0 <= box_.x1 - d ? count_at(flats_, d) : 0;
}

size_t SahNode2d::flat_right_count(double d) const {
  return count_at(flats_, d) - flat_left_count(d);
}

double SahNode2d::left_probability(double d) const {
  return (box_.height() + (d - box_.x0)) / (box_.width() + box_.height());
}

double SahNode2d::right_probability(double d) const {
  return (box_.height() + (box_.x1 - d)) / (box_.width() + box_.height());
}

double SahNode2d::cost(double d) const {
  return costs_.intersection * (static_cast<double>(left_count(d)) * left_probability(d) +
                                static_cast<double>(right_count(d)) * right_probability(d)) +
         costs_.traversal;
}

double SahNode2d::cost_without_split() const {
  return static_cast<double>(triangle_count()) * costs_.intersection;
}

std::optional<SahNode2d::Split> SahNode2d::best_split() const {
  std::optional<Split> best;
  for (const double d : candidates_) {
    const double cost_here = cost(d);
    if (!best || cost_here < best->cost) best = Split{d, cost_here};
  }
  return best;
}

}  // namespace tracer
