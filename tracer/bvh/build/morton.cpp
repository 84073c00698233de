// SPDX-License-Identifier: MIT
#include <bit>

#include "tracer/base/scratch_array.h"
#include "tracer/bvh/build/builders.h"
#include "tracer/bvh/build/chunks.h"
#include "tracer/bvh/build/radix_sort.h"
#include "tracer/bvh/build/split_cost.h"
#include "tracer/bvh/build/tree_part.h"

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
    BvhTree tree;
    if (count_ == 0) return tree;
    const PrimitiveRange all{0, count_};
    for_each_chunk(all, progress_, [&](uint32_t, PrimitiveRange part) {
      for (uint32_t i = part.begin; i < part.end; ++i) keys_[i].primitive = i;
    });
    sort_along_curve(all);
    progress_.set_fraction(sorted_fraction);
    TreePart top;
    build_part(all, 0, top);
    tree = join(top);
    tree.primitives.resize(count_);
    for_each_chunk(all, progress_, [&](uint32_t, PrimitiveRange part) {
      for (uint32_t i = part.begin; i < part.end; ++i) tree.primitives[i] = keys_[i].primitive;
    });
    return tree;
  }

 private:
  static constexpr double sorted_fraction = 0.4;  // of the time

  // Sorts the range by a curve over its own bounds. False where that tells none of its centres
  // from another: the order is then as it was.
  bool sort_along_curve(PrimitiveRange range) {
    std::vector<Box4> bounds(chunk_count(range));
    for_each_chunk(range, progress_, [&](uint32_t chunk, PrimitiveRange part) {
      Box4 half_centers;
      for (uint32_t i = part.begin; i < part.end; ++i) half_centers.extend(half_center_of(box(i)));
      bounds[chunk] = half_centers;
    });
    for (const Box4& part : bounds) bounds[0].extend(part);
    const CurveGrid grid(bounds[0]);
    for_each_chunk(range, progress_, [&](uint32_t, PrimitiveRange part) {
      for (uint32_t i = part.begin; i < part.end; ++i) {
        scratch_[i] = {grid.code(box(i)), keys_[i].primitive};
      }
    });
    radix_sort({scratch_.data(), count_}, {keys_.data(), count_}, range, progress_);
    return grid.parts_something();
  }

  Box4 build_part(PrimitiveRange range, int depth, TreePart& part) {
    if (range.count() <= task_size || is_leaf(range, depth)) {
      progress_.throw_if_stopped();
      fetch(range);
      part.nodes.reserve(likely_node_count(range.count(), leaf_size_));
      part.nodes.resize(1);
      const Box4 bounds = subdivide(range, depth, part.nodes, 0);
      report_placed(range.count());
      return bounds;
    }
    const uint32_t middle = split(range, depth);
    Box4 bounds, right_bounds;
    build_both(
        part,
        [&](TreePart& left) {
          bounds = build_part({range.begin, middle}, depth + 1, left);
        },
        [&](TreePart& right) {
          right_bounds = build_part({middle, range.end}, depth + 1, right);
        });
    bounds.extend(right_bounds);
    part.nodes = {{bounds.box()}};
    return bounds;
  }

  // Into the cache, in one go: searches and leaves would wait for each in turn.
  void fetch(PrimitiveRange range) const {
    for_each_position(range, progress_,
                      [&](uint32_t i) { __builtin_prefetch(&boxes_[keys_[i].primitive]); });
  }

  // Turns nodes[node] into the root over the range and appends what is below it.
  Box4 subdivide(PrimitiveRange range, int depth, std::vector<BvhNode>& nodes, uint32_t node) {
    Box4 bounds;
    if (is_leaf(range, depth)) {
      for_each_position(range, progress_, [&](uint32_t i) { bounds.extend(box(i)); });
      nodes[node] = {bounds.box(), range.begin, range.count()};
      return bounds;
    }
    const uint32_t middle = split(range, depth);
    const auto children = static_cast<uint32_t>(nodes.size());
    nodes.resize(nodes.size() + 2);
    bounds = subdivide({range.begin, middle}, depth + 1, nodes, children);
    bounds.extend(subdivide({middle, range.end}, depth + 1, nodes, children + 1));
    nodes[node] = {bounds.box(), children, 0};
    return bounds;
  }

  // The first position of the right child.
  uint32_t split(PrimitiveRange range, int depth) {
    const uint32_t half = range.begin + range.count() / 2;
    if (differing_bits(range) == 0 && !sort_along_curve(range)) return half;
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
    uint32_t first = range.begin;
    uint32_t count = range.count();
    // Without a branch: which half it is cannot be predicted.
    while (count > 8) {
      const uint32_t half = count / 2;
      first += is_left(first + half - 1) ? half : 0;
      count -= half;
    }
    uint32_t left_count = 0;
    for (uint32_t i = first; i < first + count; ++i) left_count += is_left(i);
    return first + left_count;
  }

  Box4 box(uint32_t position) const { return Box4(boxes_[keys_[position].primitive]); }
  bool is_leaf(PrimitiveRange range, int depth) const {
    return depth >= max_depth_ || range.count() <= static_cast<uint32_t>(leaf_size_);
  }

  void report_placed(uint32_t count) {
    const uint32_t placed = placed_.fetch_add(count, std::memory_order_relaxed) + count;
    const double part = static_cast<double>(placed) / count_;
    progress_.set_fraction(sorted_fraction + (1 - sorted_fraction) * part);
  }

  const std::span<const Box> boxes_;
  const uint32_t count_;
  const int leaf_size_;
  const int max_depth_;
  Progress& progress_;
  ScratchArray<CurveKey> keys_;  // sorted by code within each range that is still to be split
  ScratchArray<CurveKey> scratch_;
  std::atomic<uint32_t> placed_{0};
};

}  // namespace

BvhTree build_morton(const Primitives& primitives, const BuildSettings& settings,
                     Progress& progress) {
  return MortonBuild(primitives, settings, progress).build();
}

}  // namespace tracer
