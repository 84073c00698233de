// SPDX-License-Identifier: MIT
#include "tests/bench/compare/place_labels.h"

#include <algorithm>
#include <numeric>

namespace bench {
namespace {

constexpr double width_a_letter = 0.62 * label_size;  // of the font, in the mean and some more

double width_of(const std::string& label) {
  return width_a_letter * static_cast<double>(label.size());
}

Rectangle around(double x, double y) {
  return {x - marker_radius, y - marker_radius, x + marker_radius, y + marker_radius};
}

// Nearest first: a little over the point, so that a line through it is not in the way, on its right
// or left, then higher and lower.
std::vector<Rectangle> candidates_of(const LabelledPoint& point) {
  const double width = width_of(point.label);
  constexpr double half_height = 0.6 * label_size;
  constexpr double gap = marker_radius + 4;
  std::vector<Rectangle> candidates;
  const auto add = [&](double left, double middle) {
    candidates.push_back({left, middle - half_height, left + width, middle + half_height});
  };
  for (int step = 1; step < 14; ++step) {
    for (const double side : {-1.0, 1.0}) {
      const double middle = point.y + side * step * 0.7 * label_size;
      add(point.x + gap, middle);
      add(point.x - gap - width, middle);
      if (step >= 3) add(point.x - width / 2, middle);
      if (step >= 3) add(point.x + 2 * gap, middle);
    }
  }
  return candidates;
}

}  // namespace

std::vector<Rectangle> place_labels(const std::vector<LabelledPoint>& points,
                                    const Rectangle& bounds) {
  std::vector<Rectangle> taken;
  for (const LabelledPoint& point : points) taken.push_back(around(point.x, point.y));
  // Points at the edges have the least choice.
  std::vector<size_t> order(points.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, std::greater(), [&](size_t i) { return points[i].y; });
  std::vector<Rectangle> places(points.size());
  for (const size_t i : order) {
    const std::vector<Rectangle> candidates = candidates_of(points[i]);
    const auto is_free = [&](const Rectangle& place) {
      return bounds.contains(place) && std::ranges::none_of(taken, [&](const Rectangle& other) {
               return place.overlaps(other);
             });
    };
    const auto found = std::ranges::find_if(candidates, is_free);
    places[i] = found == candidates.end() ? candidates.front() : *found;
    taken.push_back(places[i]);
  }
  return places;
}

}  // namespace bench
