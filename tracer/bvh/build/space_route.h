// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/bvh/build/split_bins.h"

namespace tracer {

/// Cuts references at a plane, or leaves them whole where that costs less. [Stich 2009] 4.2, 4.4
class SpaceRoute {
 public:
  /// All that is given outlives it.
  SpaceRoute(const SplitCandidate& split, float plane, const Primitives& primitives,
             const BlockCount& block_count)
      : split_(split), plane_(plane), primitives_(primitives), block_count_(block_count) {}

  /// Gives the reference, or either part of it, to sink.to_left() or sink.to_right().
  template <class Sink>
  void operator()(const Reference& reference, Sink& sink) const {
    if (reference.max[split_.axis] <= plane_) return sink.to_left(reference);
    if (reference.min[split_.axis] >= plane_) return sink.to_right(reference);
    const Box4 box = reference.box();
    const double cut = split_.cost;
    const double left = cost_with(split_.left, box) + cost_without(split_.right);
    const double right = cost_without(split_.left) + cost_with(split_.right, box);
    if (left < cut && left <= right) return sink.to_left(reference);
    if (right < cut) return sink.to_right(reference);
    std::array<Box4, 2> parts;
    primitives_.slice(reference.primitive, split_.axis, {&plane_, 1}, parts);
    const Box left_part = intersection(parts[0], box).box();
    const Box right_part = intersection(parts[1], box).box();
    if (!left_part.is_empty()) sink.to_left({left_part, reference.primitive});
    if (!right_part.is_empty()) sink.to_right({right_part, reference.primitive});
  }

 private:
  double cost_with(const SplitSide& side, const Box4& box) const {
    Box4 bounds = side.bounds;
    bounds.extend(box);
    return bounds.half_area() * block_count_(side.count);
  }
  double cost_without(const SplitSide& side) const {
    return side.bounds.half_area() * block_count_(side.count - 1);
  }

  const SplitCandidate& split_;
  const float plane_;
  const Primitives& primitives_;
  const BlockCount& block_count_;
};

}  // namespace tracer
