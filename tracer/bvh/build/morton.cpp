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

// Bits 0 to 9 of each lane go to every third.
Int4 spread(Int4 cells) {
  cells = (cells | cells << 16) & 0x030000ff;
  cells = (cells | cells << 8) & 0x0300f00f;
  cells = (cells | cells << 4) & 0x030c30c3;
  return (cells | cells << 2) & 0x09249249;
}

/// Cells over the bounds of half centres, 2 ^ `bits` along each axis.
class CurveGrid {
 public:
  CurveGrid(const Box4& half_centers, int bits) : origin_(half_centers.min) {
    const float cells_a_side = static_cast<float>(1 << bits);
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

// More are told apart by 10 bits along each axis, fewer by 8, sorted in two passes for three.
constexpr uint32_t most_on_coarse_grid = 1 << 18;

// A split is a search, where others look at every primitive.
constexpr uint32_t search_task_size = 2 * task_size;

class MortonBuild {
 public:
  MortonBuild(const Primitives& primitives, const BuildSettings& settings, Progress& progress)
      : boxes_(primitives.boxes),
        count_(static_cast<uint32_t>(boxes_.size())),
        leaf_size_(std::max(settings.leaf_size, 1)),
        max_depth_(std::min(settings.max_depth, max_tree_depth)),
        progress_(progress),
        codes_(count_ + codes_a_search) {}

  BvhTree build() {
    if (count_ == 0) return {};
    const PrimitiveRange all{0, count_};
    tree_.primitives.resize(count_);
    sort_along_curve(all, [](uint32_t position) { return position; });
    progress_.set_fraction(sorted_fraction);
    Shape shape;
    split_all(all, 0, shape);
    progress_.set_fraction(split_fraction);
    tree_.nodes.resize(shape.node_count);
    place(shape, all, 0, {0, 1});
    return std::move(tree_);
  }

 private:
  static constexpr double sorted_fraction = 0.4;  // of the time
  static constexpr double split_fraction = 0.6;
  static constexpr uint32_t codes_a_search = 8;  // compared with at once

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
    const int bits = range.count() <= most_on_coarse_grid ? 8 : 10;
    const CurveGrid grid(bounds[0], bits);
    ScratchArray<CurveKey> keys(range.count()), scratch(range.count());
    for_each_chunk(range, progress_, [&](uint32_t, PrimitiveRange part) {
      for (uint32_t i = part.begin; i < part.end; ++i) {
        const uint32_t primitive = primitive_of(i);
        keys[i - range.begin] = {grid.code(Box4(boxes_[primitive])), primitive};
      }
    });
    const std::span<const CurveKey> sorted = radix_sort(
        {keys.data(), range.count()}, {scratch.data(), range.count()}, 3 * bits, progress_);
    for_each_chunk(range, progress_, [&](uint32_t, PrimitiveRange part) {
      for (uint32_t i = part.begin; i < part.end; ++i) {
        codes_[i] = sorted[i - range.begin].code;
        tree_.primitives[i] = sorted[i - range.begin].primitive;
      }
    });
    return grid.parts_something();
  }

  void split_all(PrimitiveRange range, int depth, Shape& shape) {
    if (range.count() <= search_task_size || is_leaf(range, depth)) {
      progress_.throw_if_stopped();
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

  // Into the cache, in one go: leaves would wait for each in turn.
  void fetch_boxes(PrimitiveRange range) const {
    for_each_position(range, progress_,
                      [&](uint32_t i) { __builtin_prefetch(&boxes_[tree_.primitives[i]]); });
  }

  // The first position of the right child.
  uint32_t split(PrimitiveRange range, int depth) {
    const uint32_t half = range.begin + range.count() / 2;
    const auto primitive_of = [this](uint32_t i) { return tree_.primitives[i]; };
    if (differing_bits(range) == 0 && !sort_along_curve(range, primitive_of)) return half;
    const uint32_t middle = first_with_highest_differing_bit(range);
    const uint32_t limit = side_limit(range.count(), leaf_size_, max_depth_ - depth);
    return std::clamp(middle, range.end - limit, range.begin + limit);
  }

  uint32_t differing_bits(PrimitiveRange range) const {
    return codes_[range.begin] ^ codes_[range.end - 1];
  }

  uint32_t first_with_highest_differing_bit(PrimitiveRange range) const {
    const uint32_t bit = std::bit_floor(differing_bits(range));
    const uint32_t first_code = codes_[range.end - 1] & ~(bit - 1);
    const uint32_t* codes = &codes_[range.begin];
    uint32_t count = range.count();
    // Without a branch: which half it is cannot be predicted.
    while (count > codes_a_search) {
      const uint32_t half = count / 2;
      codes += half & -static_cast<uint32_t>(codes[half - 1] < first_code);
      count -= half;
    }
    // The last of them has the bit, so that it may be looked at again in the place of what follows
    // the range, which another thread may be sorting.
    uint32_t left_count = 0;
    for (uint32_t i = 0; i < codes_a_search; ++i) {
      left_count += static_cast<uint32_t>(codes[std::min(i, count - 1)] < first_code);
    }
    return static_cast<uint32_t>(codes - codes_.data()) + left_count;
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
  // Of tree_.primitives, which are sorted by them within each range that is still to be split.
  ScratchArray<uint32_t> codes_;
  BvhTree tree_;
  std::atomic<uint32_t> placed_{0};
};

}  // namespace

BvhTree build_morton(const Primitives& primitives, const BuildSettings& settings,
                     Progress& progress) {
  return MortonBuild(primitives, settings, progress).build();
}

}  // namespace tracer
