// SPDX-License-Identifier: MIT
// The surface area heuristic for a kd-tree node in the plane, split by the line x = d
// ([Assignment 2006] 3.3, after [MacDonald 1990]). docs/sah-2d.md proves where its minima are.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace tracer {

/// [x0, x1] x [y0, y1], of positive perimeter.
struct Rectangle {
  double x0, y0, x1, y1;

  double width() const { return x1 - x0; }
  double height() const { return y1 - y0; }
};

/// What a triangle covers of the x-axis, min <= max.
struct XInterval {
  double min, max;
};

struct SahCosts {
  double intersection = 1;  // C_I > 0, of a ray with one triangle
  double traversal = 1;     // C_T >= 0, of one step down the tree
};

/// The cost of one node as a function of d in [box.x0, box.x1]. A triangle counts on each side
/// where it covers more than the line x = d itself; one without width that lies in that line counts
/// with the narrower side, left of equals. So the cost at a jump is the lower of the values around
/// it, and the least cost is always attained.
class SahNode2d {
 public:
  /// Triangles are clipped to the box; those outside are not of this node.
  SahNode2d(const Rectangle& box, std::span<const XInterval> triangles, const SahCosts& costs);

  size_t triangle_count() const { return starts_.size(); }  // N
  size_t left_count(double d) const;                        // N_left(d)
  size_t right_count(double d) const;                       // N_right(d)
  double left_probability(double d) const;                  // p_left(d)
  double right_probability(double d) const;                 // p_right(d)
  double cost(double d) const;                              // C(d)
  double cost_without_split() const;                        // C_nosplit

  /// Where a count changes, ascending: all ends of the clipped triangles. All local minima but
  /// plateaus lie here.
  std::span<const double> candidates() const { return candidates_; }

  struct Split {
    double d;
    double cost;
  };
  /// The lowest d of least cost; none for a node without triangles.
  std::optional<Split> best_split() const;

 private:
  // Triangles without width at d that count on the left, or on the right.
  size_t flat_left_count(double d) const;
  size_t flat_right_count(double d) const;

  Rectangle box_;
  SahCosts costs_;
  // Sorted.
  std::vector<double> starts_;
  std::vector<double> ends_;
  std::vector<double> flats_;
  std::vector<double> candidates_;
};

}  // namespace tracer
