// SPDX-License-Identifier: MIT
// Labels beside points, none over another.
#pragma once

#include <string>
#include <vector>

namespace bench {

struct Rectangle {
  double left, top, right, bottom;

  bool overlaps(const Rectangle& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
  bool contains(const Rectangle& other) const {
    return left <= other.left && other.right <= right && top <= other.top && other.bottom <= bottom;
  }
};

/// A point at (x, y), with a marker of radius marker_radius around it.
struct LabelledPoint {
  double x, y;
  std::string label;
};

inline constexpr double marker_radius = 6;
inline constexpr double label_size = 13;

/// Where each label goes: beside its point where there is room, else farther off. All lie in
/// `bounds` and none over a marker or another label, unless nothing else is left.
std::vector<Rectangle> place_labels(const std::vector<LabelledPoint>& points,
                                    const Rectangle& bounds);

}  // namespace bench
