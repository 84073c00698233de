// SPDX-License-Identifier: MIT
#include <bit>
#include <memory>

#include "tracer/base/scratch_array.h"
#include "tracer/bvh/build/builders.h"
#include "tracer/bvh/build/chunks.h"
#include "tracer/bvh/build/radix_sort.h"
#include "tracer/bvh/build/split_cost.h"

namespace tracer {
namespace {

// Cells along each axis, over the bounds of half centres.
constexpr int cells_a_side = 1024;

// Bits 0 to 9 of each lane go to every third.
Int4 spread(Int4 cells) {
  cells = (cells | cells << 16) & 0x030000ff;
  cells = (cells | cells << 8) & 0x0300f00f;
  cells = (cells | cells << 4) & 0x030c30c3;
  return (cells | cells << 2) & 0x09249249;
}

class CurveGrid {
 public:
  explicit CurveGrid(const Box4& half_centers) : origin_(half_centers.min) {
    const Float4 scale = cells_a_side * 0.9999f / (half_centers.max - half_centers.min);
    scale_ = scale < Box4::infinity ? scale : Float4{};
  }

  bool parts_something() const { return scale_[0] + scale_[1] + scale_[2] > 0; }
  uint32_t code(const Box4& box) const {
    const Float4 position = (half_center_of(box) - origin_) * scale_;
    const Int4 bits = spread(__builtin_convertvector(position, Int4));
    return static_cast<uint32_t>(bits[0] << 2 | bits[1] << 1 | bits[2]);
  }

 private:
  Float4 origin_;
  Float4 scale_;
};

class MortonBuild {
 public:
  MortonBuild(const Primitives& primitives, const BuildSettings& settings, Progress& progress)
      : boxes_(primitives.boxes),
        count_(static_cast<uint32_t>(boxes_.size())),
        leaf_size_(std::max(settings.leaf_size, 1)),
        max_depth_(std::min(settings.max_depth, max_tree_depth)),
        progress_(progress),
        keys_(count_),
        scratch_(count_) {}

  BvhTree build() {
    if (count_ == 0) return {};
    const PrimitiveRange all{0, count_};
    sort_along_curve(all, [](uint32_t position) { return position; });
    progress_.set_fraction(sorted_fraction);
    Shape shape;
    split_all(all, 0, shape);
    progress_.set_fraction(split_fraction);
    tree_.nodes.resize(shape.node_count);
    tree_.primitives.resize(count_);
    place(shape, all, 0, {0, 1});
    return std::move(tree_);
  }

 private:
  static constexpr double sorted_fraction = 0.4;  // of the time
  static constexpr double split_fraction = 0.6;

  /// How a range is split, all the way down: known before any box, so that each node is written
  /// once and where it belongs.
  struct Shape {
    uint32_t node_count = 0;
    uint32_t middle = 0;            // of the root, where it is made of two others
    std::vector<uint32_t> middles;  // else: of each inner node, parents and left ones first
    std::unique_ptr<Shape> left, right;
  };

  /// Of the root and of all other nodes.
  struct Slots {
    uint32_t root;
    uint32_t below;
  };

  // Sorts the range by a curve over its own bounds; `primitive_of` tells which is where before.
  // False where that tells none of its centres from another: the order is then as it was.
  template <class F>
  bool sort_along_curve(PrimitiveRange range, const F& primitive_of) {
    std::vector<Box4> bounds(chunk_count(range));
    for_each_chunk(range, progress_, [&](uint32_t chunk, PrimitiveRange part) {
      Box4 half_centers;
      for (uint32_t i = part.begin; i < part.end; ++i) {
        half_centers.extend(half_center_of(Box4(boxes_[primitive_of(i)])));
      }
      bounds[chunk] = half_centers;
    });
    for (const Box4& part : bounds) bounds[0].extend(part);
    const CurveGrid grid(bounds[0]);
    for_each_chunk(range, progress_, [&](uint32_t, PrimitiveRange part) {
      for (uint32_t i = part.begin; i < part.end; ++i) {
        const uint32_t primitive = primitive_of(i);
        scratch_[i] = {grid.code(Box4(boxes_[primitive])), primitive};
      }
    });
    radix_sort({scratch_.data(), count_}, {keys_.data(), count_}, range, progress_);
    return grid.parts_something();
  }

  void split_all(PrimitiveRange range, int depth, Shape& shape) {
    if (range.count() <= task_size || is_leaf(range, depth)) {
      progress_.throw_if_stopped();
      fetch_keys(range);
      shape.middles.reserve(likely_node_count(range.count(), leaf_size_) / 2);
      split_serially(range, depth, shape.middles);
      shape.node_count = 1 + 2 * static_cast<uint32_t>(shape.middles.size());
      return;
    }
    const uint32_t middle = shape.middle = split(range, depth);
    shape.left = std::make_unique<Shape>();
    shape.right = std::make_unique<Shape>();
    do_both(
        [&] {
          split_all({range.begin, middle}, depth + 1, *shape.left);
        },
        [&] {
          split_all({middle, range.end}, depth + 1, *shape.right);
        });
    shape.node_count = 1 + shape.left->node_count + shape.right->node_count;
  }

  void split_serially(PrimitiveRange range, int depth, std::vector<uint32_t>& middles) {
    if (is_leaf(range, depth)) return;
    const uint32_t middle = split(range, depth);
    middles.push_back(middle);
    split_serially({range.begin, middle}, depth + 1, middles);
    split_serially({middle, range.end}, depth + 1, middles);
  }

  // Writes the nodes of a shape over the range.
  Box4 place(const Shape& shape, PrimitiveRange range, int depth, Slots slots) {
    if (!shape.left) {
      fetch_boxes(range);
      const uint32_t* middle = shape.middles.data();
      const Box4 bounds = place_serially(middle, range, depth, slots.root, slots.below);
      report_placed(range.count());
      return bounds;
    }
    const uint32_t children = slots.below;
    const uint32_t below = children + 2;
    Box4 bounds, right_bounds;
    do_both(
        [&] {
          bounds = place(*shape.left, {range.begin, shape.middle}, depth + 1, {children, below});
        },
        [&] {
          right_bounds = place(*shape.right, {shape.middle, range.end}, depth + 1,
                               {children + 1, below + shape.left->node_count - 1});
        });
    bounds.extend(right_bounds);
    tree_.nodes[slots.root] = {bounds.box(), children, 0};
    return bounds;
  }

  // Takes the middles one by one, and slots from `next` on.
  Box4 place_serially(const uint32_t*& middle, PrimitiveRange range, int depth, uint32_t node,
                      uint32_t& next) {
    Box4 bounds;
    if (is_leaf(range, depth)) {
      for_each_position(range, progress_,
                        [&](uint32_t i) { bounds.extend(Box4(boxes_[tree_.primitives[i]])); });
      tree_.nodes[node] = {bounds.box(), range.begin, range.count()};
      return bounds;
    }
    const uint32_t right_begin = *middle++;
    const uint32_t children = next;
    next += 2;
    bounds = place_serially(middle, {range.begin, right_begin}, depth + 1, children, next);
    bounds.extend(place_serially(middle, {right_begin, range.end}, depth + 1, children + 1, next));
    tree_.nodes[node] = {bounds.box(), children, 0};
    return bounds;
  }

  // Into the cache, in one go: searches would wait for each in turn.
  void fetch_keys(PrimitiveRange range) const {
    constexpr uint32_t keys_a_line = 64 / sizeof(CurveKey);
    for (uint32_t i = range.begin; i < range.end; i += keys_a_line) __builtin_prefetch(&keys_[i]);
  }

  // And so would leaves.
  void fetch_boxes(PrimitiveRange range) {
    for_each_position(range, progress_, [&](uint32_t i) {
      const uint32_t primitive = tree_.primitives[i] = keys_[i].primitive;
      __builtin_prefetch(&boxes_[primitive]);
    });
  }

  // The first position of the right child.
  uint32_t split(PrimitiveRange range, int depth) {
    const uint32_t half = range.begin + range.count() / 2;
    const auto primitive_of = [this](uint32_t i) { return keys_[i].primitive; };
    if (differing_bits(range) == 0 && !sort_along_curve(range, primitive_of)) return half;
    const uint32_t middle = first_with_highest_differing_bit(range);
    const uint32_t limit = side_limit(range.count(), leaf_size_, max_depth_ - depth);
    return std::clamp(middle, range.end - limit, range.begin + limit);
  }

  uint32_t differing_bits(PrimitiveRange range) const {
    return keys_[range.begin].code ^ keys_[range.end - 1].code;
  }

  uint32_t first_with_highest_differing_bit(PrimitiveRange range) const {
    const uint32_t bit = std::bit_floor(differing_bits(range));
    const auto is_left = [&](uint32_t i) { return (keys_[i].code & bit) == 0; };
    const uint32_t last = range.end - 1;
    uint32_t first = range.begin;
    uint32_t count = range.count();
    // Without a branch: which half it is cannot be predicted.
    while (count > 8) {
      const uint32_t half = count / 2;
      first += is_left(first + half - 1) ? half : 0;
      count -= half;
    }
    uint32_t left_count = 0;
    for (uint32_t i = 0; i < 8; ++i) left_count += is_left(std::min(first + i, last));
    return first + left_count;
  }

  bool is_leaf(PrimitiveRange range, int depth) const {
    return depth >= max_depth_ || range.count() <= static_cast<uint32_t>(leaf_size_);
  }

  void report_placed(uint32_t count) {
    const uint32_t placed = placed_.fetch_add(count, std::memory_order_relaxed) + count;
    const double part = static_cast<double>(placed) / count_;
    progress_.set_fraction(split_fraction + (1 - split_fraction) * part);
  }

  const std::span<const Box> boxes_;
  const uint32_t count_;
  const int leaf_size_;
  const int max_depth_;
  Progress& progress_;
  ScratchArray<CurveKey> keys_;  // sorted by code within each range that is still to be split
  ScratchArray<CurveKey> scratch_;
  BvhTree tree_;
  std::atomic<uint32_t> placed_{0};
};

}  // namespace

BvhTree build_morton(const Primitives& primitives, const BuildSettings& settings,
                     Progress& progress) {
  return MortonBuild(primitives, settings, progress).build();
}

}  // namespace tracer
