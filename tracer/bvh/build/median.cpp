// SPDX-License-Identifier: MIT
#include "tracer/bvh/build/builders.h"
#include "tracer/bvh/build/subdivide.h"

namespace tracer {
namespace {

struct Reference {
  Box box;
  uint32_t primitive;
};

class MedianSplitter {
 public:
  MedianSplitter(std::span<const Box> boxes, const Progress& progress)
      : references_(boxes.size()), progress_(progress) {
    parallel_for_ranges(0, boxes.size(), 16384, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) references_[i] = {boxes[i], static_cast<uint32_t>(i)};
    });
  }

  Box bounds(PrimitiveRange range) const {
    Box bounds;
    for_each_position(range, progress_, [&](uint32_t i) { bounds.extend(references_[i].box); });
    return bounds;
  }

  uint32_t split(PrimitiveRange range, const Box& bounds, int /*levels_left*/) {
    uint32_t middle = halve_across_longest_side(range, bounds);
    if (!has_two_sides(range, middle)) middle = halve_across_longest_side(range, centers(range));
    if (!has_two_sides(range, middle)) middle = range.begin + range.count() / 2;
    return middle;
  }

  std::vector<uint32_t> take_order() const {
    std::vector<uint32_t> primitives(references_.size());
    for (size_t i = 0; i < primitives.size(); ++i) primitives[i] = references_[i].primitive;
    return primitives;
  }

 private:
  // Compared in double: the middle of two different floats lies strictly between them.
  uint32_t halve_across_longest_side(PrimitiveRange range, const Box& box) {
    const int axis = box.longest_axis();
    const double plane = 0.5 * (static_cast<double>(box.min[axis]) + box.max[axis]);
    const auto first = references_.begin();
    const auto right = std::partition(
        first + range.begin, first + range.end,
        [&](const Reference& reference) { return reference.box.center()[axis] < plane; });
    return static_cast<uint32_t>(right - first);
  }

  Box centers(PrimitiveRange range) const {
    Box centers;
    for_each_position(range, progress_,
                      [&](uint32_t i) { centers.extend(references_[i].box.center()); });
    return centers;
  }

  static bool has_two_sides(PrimitiveRange range, uint32_t middle) {
    return middle != range.begin && middle != range.end;
  }

  std::vector<Reference> references_;
  const Progress& progress_;
};

}  // namespace

BvhTree build_median(const Primitives& primitives, const BuildSettings& settings,
                     Progress& progress) {
  MedianSplitter splitter(primitives.boxes, progress);
  const auto count = static_cast<uint32_t>(primitives.boxes.size());
  return Subdivision(splitter, count, settings, progress).build();
}

}  // namespace tracer
