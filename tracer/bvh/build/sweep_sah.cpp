// SPDX-License-Identifier: MIT
#include <array>
#include <numeric>
#include <tuple>

#include "tracer/bvh/build/builders.h"
#include "tracer/bvh/build/split_cost.h"
#include "tracer/bvh/build/subdivide.h"

namespace tracer {
namespace {

// Sorted once by centre along each axis; every split keeps all three orders sorted.
class SweepSplitter {
 public:
  SweepSplitter(std::span<const Box> boxes, const BuildSettings& settings, const Progress& progress)
      : boxes_(boxes),
        leaf_size_(std::max(settings.leaf_size, 1)),
        block_count_(settings),
        progress_(progress),
        right_areas_(boxes.size()),
        scratch_(boxes.size()),
        goes_left_(boxes.size()) {
    parallel_for_each_index(0, 3, [&](size_t axis) { sort_by_center(static_cast<int>(axis)); });
  }

  Box bounds(PrimitiveRange range) const {
    Box bounds;
    for_each_position(range, progress_, [&](uint32_t i) { bounds.extend(boxes_[orders_[0][i]]); });
    return bounds;
  }

  uint32_t split(PrimitiveRange range, const Box& /*bounds*/, int levels_left) {
    const uint32_t limit = side_limit(range.count(), leaf_size_, levels_left);
    Candidate best = best_candidate(range, 0, limit);
    for (int axis = 1; axis < 3; ++axis) {
      const Candidate candidate = best_candidate(range, axis, limit);
      if (candidate.is_better_than(best)) best = candidate;
    }
    const uint32_t middle = range.begin + best.left_count;
    for (uint32_t i = range.begin; i < range.end; ++i) {
      goes_left_[orders_[best.axis][i]] = i < middle;
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (axis != best.axis) partition_stably(range, orders_[axis]);
    }
    return middle;
  }

  std::vector<uint32_t> take_order() { return std::move(orders_[0]); }

 private:
  struct Candidate {
    double cost = std::numeric_limits<double>::infinity();
    uint32_t larger_side = 0xffffffffu;
    int axis = 0;
    uint32_t left_count = 0;

    bool is_better_than(const Candidate& other) const {
      return std::tie(cost, larger_side) < std::tie(other.cost, other.larger_side);
    }
  };

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

  Candidate best_candidate(PrimitiveRange range, int axis, uint32_t limit) {
    const std::vector<uint32_t>& order = orders_[axis];
    const uint32_t count = range.count();
    Box right;
    for_each_position(range, progress_, [&](uint32_t i) {
      const uint32_t mirrored = range.end - 1 - (i - range.begin);
      right.extend(boxes_[order[mirrored]]);
      right_areas_[mirrored] = right.half_area();
    });
    Box left;
    Candidate best;
    for_each_position({range.begin, range.end - 1}, progress_, [&](uint32_t i) {
      left.extend(boxes_[order[i]]);
      const uint32_t left_count = i + 1 - range.begin;
      const uint32_t larger_side = std::max(left_count, count - left_count);
      if (larger_side > limit) return;
      const double left_area = left.half_area();
      const double right_area = right_areas_[i + 1];
      const double left_blocks = block_count_(left_count);
      const double right_blocks = block_count_(count - left_count);
      // left_area * left_blocks + right_area * right_blocks, arranged so that boxes that are all
      // the same cost exactly the same at every plane of as many blocks.
      const double cost =
          right_area * (left_blocks + right_blocks) + (left_area - right_area) * left_blocks;
      const Candidate candidate{cost, larger_side, axis, left_count};
      if (candidate.is_better_than(best)) best = candidate;
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
    std::copy(scratch_.begin() + range.begin, scratch_.begin() + right_end,
              order.begin() + left_end);
  }

  const std::span<const Box> boxes_;
  const int leaf_size_;
  const BlockCount block_count_;
  const Progress& progress_;
  std::array<std::vector<uint32_t>, 3> orders_;  // primitives; each node owns a range of all three
  std::vector<double> right_areas_;  // by position: of all from there to the range's end
  std::vector<uint32_t> scratch_;    // by position
  std::vector<uint8_t> goes_left_;   // by primitive
};

}  // namespace

BvhTree build_sweep_sah(const Primitives& primitives, const BuildSettings& settings,
                        Progress& progress) {
  SweepSplitter splitter(primitives.boxes, settings, progress);
  const auto count = static_cast<uint32_t>(primitives.boxes.size());
  return Subdivision(splitter, count, settings, progress).build();
}

}  // namespace tracer
