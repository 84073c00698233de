// SPDX-License-Identifier: MIT
#include <array>
#include <numeric>
#include <tuple>

#include "tracer/base/scratch_array.h"
#include "tracer/bvh/build/builders.h"
#include "tracer/bvh/build/split_cost.h"
#include "tracer/bvh/build/subdivide.h"

namespace tracer {
namespace {

// Sorted once by centre along each axis; every split keeps all three orders sorted.
class SweepSplitter {
 public:
  SweepSplitter(std::span<const Box> boxes, const BuildSettings& settings, const Progress& progress)
      : leaf_size_(std::max(settings.leaf_size, 1)),
        block_count_(settings),
        progress_(progress),
        boxes_(boxes),
        scaled_boxes_(boxes.size()),
        right_areas_(boxes.size()),
        scratch_(boxes.size()),
        goes_left_(boxes.size()) {
    scale_boxes();
    parallel_for_each_index(0, 3, [&](size_t axis) { sort_by_center(static_cast<int>(axis)); });
  }

  Box bounds(PrimitiveRange range) const {
    Box bounds;
    for_each_position(range, progress_, [&](uint32_t i) { bounds.extend(boxes_[orders_[0][i]]); });
    return bounds;
  }

  uint32_t split(PrimitiveRange range, const Box& /*bounds*/, int levels_left) {
    const BestSplits best = best_splits(range, side_limit(range.count(), leaf_size_, levels_left));
    const int best_axis = best.axis();
    const uint32_t middle = range.begin + static_cast<uint32_t>(best.place());
    for (uint32_t i = range.begin; i < range.end; ++i) {
      goes_left_[orders_[best_axis][i]] = i < middle;
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (axis != best_axis) partition_stably(range, orders_[axis]);
    }
    return middle;
  }

  std::vector<uint32_t> take_order() { return std::move(orders_[0]); }

 private:
  void scale_boxes() {
    Box all;
    for (const Box& box : boxes_) all.extend(box);
    const float scale = unit_scale(all);
    parallel_for_ranges(0, boxes_.size(), 16384, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) scaled_boxes_[i] = scaled(Box4(boxes_[i]), scale);
    });
  }

  void sort_by_center(int axis) {
    struct Key {
      float center;
      uint32_t primitive;
    };
    std::vector<Key> keys(boxes_.size());
    for (uint32_t i = 0; i < keys.size(); ++i) keys[i] = {boxes_[i].center()[axis], i};
    uint32_t comparisons = 0;
    std::sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
      if (++comparisons % 65536 == 0) progress_.throw_if_stopped();
      return std::tie(a.center, a.primitive) < std::tie(b.center, b.primitive);
    });
    orders_[axis].resize(keys.size());
    std::ranges::transform(keys, orders_[axis].begin(), &Key::primitive);
  }

  // Every plane between two centres, by how many are left of it; an axis a lane.
  BestSplits best_splits(PrimitiveRange range, uint32_t limit) {
    Box4 x, y, z;
    const auto extend = [&](uint32_t i) {
      x.extend(scaled_boxes_[orders_[0][i]]);
      y.extend(scaled_boxes_[orders_[1][i]]);
      z.extend(scaled_boxes_[orders_[2][i]]);
    };
    const uint32_t count = range.count();
    for_each_position({range.begin + 1, range.end}, progress_, [&](uint32_t i) {
      const uint32_t mirrored = range.end - (i - range.begin);
      extend(mirrored);
      right_areas_[mirrored] = half_areas(x, y, z);
    });
    x = y = z = Box4();
    BestSplits best;
    for_each_position({range.begin + 1, range.end}, progress_, [&](uint32_t i) {
      extend(i - 1);
      const uint32_t left_count = i - range.begin;
      const uint32_t larger_side = std::max(left_count, count - left_count);
      if (larger_side > limit) return;
      best.offer(half_areas(x, y, z), Float4{} + block_count_(left_count), right_areas_[i],
                 Float4{} + block_count_(count - left_count),
                 Int4{} + static_cast<int32_t>(larger_side), ~Int4{}, static_cast<int>(left_count));
    });
    return best;
  }

  void partition_stably(PrimitiveRange range, std::vector<uint32_t>& order) {
    uint32_t left_end = range.begin;
    uint32_t right_end = range.begin;
    for_each_position(range, progress_, [&](uint32_t i) {
      const uint32_t primitive = order[i];
      if (goes_left_[primitive]) {
        order[left_end++] = primitive;
      } else {
        scratch_[right_end++] = primitive;
      }
    });
    std::copy(scratch_.data() + range.begin, scratch_.data() + right_end, order.begin() + left_end);
  }

  const int leaf_size_;
  const BlockCount block_count_;
  const Progress& progress_;
  const std::span<const Box> boxes_;
  ScratchArray<Box4> scaled_boxes_;              // by unit_scale
  std::array<std::vector<uint32_t>, 3> orders_;  // primitives; each node owns a range of all three
  ScratchArray<Float4> right_areas_;  // by position: of all from there to the range's end
  ScratchArray<uint32_t> scratch_;    // by position
  ScratchArray<uint8_t> goes_left_;   // by primitive
};

}  // namespace

BvhTree build_sweep_sah(const Primitives& primitives, const BuildSettings& settings,
                        Progress& progress) {
  SweepSplitter splitter(primitives.boxes, settings, progress);
  const auto count = static_cast<uint32_t>(primitives.boxes.size());
  return Subdivision(splitter, count, settings, progress).build();
}

}  // namespace tracer
