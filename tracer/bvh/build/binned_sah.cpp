// SPDX-License-Identifier: MIT
#include <atomic>
#include <memory>
#include <optional>
#include <tuple>

#include "tracer/base/scratch_array.h"
#include "tracer/bvh/build/bins.h"
#include "tracer/bvh/build/builders.h"
#include "tracer/bvh/build/chunks.h"
#include "tracer/bvh/build/small_sweep.h"
#include "tracer/bvh/build/tree_part.h"

namespace tracer {
namespace {

// A node before it is split. Its references are in one of two buffers, at positions `range`.
struct Part {
  PrimitiveRange range;
  int buffer;
  int depth;
  Box4 bounds;
  Box4 half_centers;
};

// What one task bins and then moves to either side.
struct Chunk {
  PrimitiveRange range;
  Bins bins;
  uint32_t left_begin;  // where its references go
  uint32_t right_begin;
  std::array<Box4, 2> half_centers;  // of either side
};

class BinnedBuild {
 public:
  BinnedBuild(const Primitives& primitives, const BuildSettings& settings, Progress& progress)
      : boxes_(primitives.boxes),
        count_(static_cast<uint32_t>(boxes_.size())),
        leaf_size_(std::max(settings.leaf_size, 1)),
        max_depth_(std::min(settings.max_depth, max_tree_depth)),
        settings_(settings),
        block_count_(settings),
        progress_(progress) {}

  BvhTree build() {
    BvhTree tree;
    if (count_ == 0) return tree;
    for (auto& buffer : buffers_) buffer = ScratchArray<Reference>(count_);
    tree.primitives.resize(count_);
    primitives_ = tree.primitives.data();
    const Part root = make_root();
    scale_ = unit_scale(root.bounds.box());
    small_costs_ = std::make_unique<SmallSweep::Costs>(scale_, settings_);
    TreePart top;
    build_part(root, top);
    tree.nodes = join(top).nodes;
    return tree;
  }

 private:
  Part make_root() {
    const PrimitiveRange range{0, count_};
    std::vector<std::array<Box4, 2>> bounds(chunk_count(range));
    for_each_chunk(range, progress_, [&](uint32_t chunk, PrimitiveRange part) {
      Box4 all, half_centers;
      for (uint32_t i = part.begin; i < part.end; ++i) {
        std::construct_at(&buffers_[0][i], boxes_[i], i);
        const Box4 box(boxes_[i]);
        all.extend(box);
        half_centers.extend(half_center_of(box));
      }
      bounds[chunk] = {all, half_centers};
    });
    Part root{range, 0, 0, Box4(), Box4()};
    for (const auto& [all, half_centers] : bounds) {
      root.bounds.extend(all);
      root.half_centers.extend(half_centers);
    }
    return root;
  }

  void build_part(const Part& part, TreePart& tree) {
    if (part.range.count() <= task_size || is_leaf(part)) {
      progress_.throw_if_stopped();
      tree.nodes.reserve(likely_node_count(part.range.count(), leaf_size_));
      tree.nodes.resize(1);
      subdivide(part, tree.nodes, 0);
      report_placed(part.range.count());
      return;
    }
    const std::array<Part, 2> sides = split(part);
    tree.nodes = {{part.bounds.box()}};
    build_both(
        tree, [&](TreePart& left) { build_part(sides[0], left); },
        [&](TreePart& right) { build_part(sides[1], right); });
  }

  // Turns nodes[node] into the root over the part and appends what is below it.
  void subdivide(const Part& part, std::vector<BvhNode>& nodes, uint32_t node) {
    const uint32_t count = part.range.count();
    if (is_leaf(part)) {
      for (uint32_t i = part.range.begin; i < part.range.end; ++i) {
        primitives_[i] = buffers_[part.buffer][i].primitive;
      }
      nodes[node] = {part.bounds.box(), part.range.begin, count};
      return;
    }
    if (count <= SmallSweep::capacity) {
      SmallSweep sweep(references(part), part.half_centers, *small_costs_);
      sweep.subdivide(nodes, node, max_depth_ - part.depth, part.range.begin,
                      primitives_ + part.range.begin);
      return;
    }
    const std::array<Part, 2> sides = split(part);
    const auto children = static_cast<uint32_t>(nodes.size());
    nodes[node] = {part.bounds.box(), children, 0};
    nodes.resize(nodes.size() + 2);
    subdivide(sides[0], nodes, children);
    subdivide(sides[1], nodes, children + 1);
  }

  std::array<Part, 2> split(const Part& part) {
    const Binning binning(part.half_centers, bin_count_for(part.range.count(), settings_));
    if (!binning.parts_something()) return halve(part);
    const uint32_t count = chunk_count(part.range);
    if (count == 1) {
      Chunk chunk;
      return split(part, binning, {&chunk, 1});
    }
    const auto chunks = std::make_unique_for_overwrite<Chunk[]>(count);
    return split(part, binning, {chunks.get(), count});
  }

  std::array<Part, 2> split(const Part& part, Binning binning, std::span<Chunk> chunks) {
    std::unique_ptr<Bins> sum;
    const Bins* bins = nullptr;
    const uint32_t limit = side_limit(part.range.count(), leaf_size_, max_depth_ - part.depth);
    const BinSplit split = find_split(
        binning,
        [&](const Binning& with) -> const Bins& {
          return *(bins = &gather_bins(part, with, chunks, sum));
        },
        [&](const Bins& of) { return of.best_split(block_count_, scale_, limit); });
    if (!split.exists()) return halve(part);

    const uint32_t middle = part.range.begin + bins->left_count(split);
    uint32_t left_begin = part.range.begin;
    uint32_t right_begin = middle;
    for (Chunk& chunk : chunks) {
      const uint32_t left_count = chunk.bins.left_count(split);
      chunk.left_begin = left_begin;
      chunk.right_begin = right_begin;
      left_begin += left_count;
      right_begin += chunk.range.count() - left_count;
    }
    for_each_chunk(part.range, progress_,
                   [&](uint32_t i, PrimitiveRange) { move(part, binning, split, chunks[i]); });

    const std::array<Box4, 2> bounds = bins->side_bounds(split);
    std::array<Part, 2> sides = empty_sides(part, middle);
    for (int side = 0; side < 2; ++side) {
      sides[side].buffer = 1 - part.buffer;
      sides[side].bounds = bounds[side];
      for (const Chunk& chunk : chunks) sides[side].half_centers.extend(chunk.half_centers[side]);
    }
    return sides;
  }

  const Bins& gather_bins(const Part& part, const Binning& binning, std::span<Chunk> chunks,
                          std::unique_ptr<Bins>& sum) {
    for_each_chunk(part.range, progress_, [&](uint32_t i, PrimitiveRange range) {
      Chunk& chunk = chunks[i];
      chunk.range = range;
      chunk.bins.clear(binning.bin_count());
      chunk.bins.add({&buffers_[part.buffer][range.begin], range.count()}, binning);
    });
    if (chunks.size() == 1) return chunks[0].bins;
    sum = std::make_unique<Bins>(chunks[0].bins);
    for (const Chunk& chunk : chunks.subspan(1)) sum->add(chunk.bins);
    return *sum;
  }

  // Stably, to the other buffer.
  void move(const Part& part, const Binning& binning, BinSplit split, Chunk& chunk) {
    const Reference* from = buffers_[part.buffer].data();
    Reference* to = buffers_[1 - part.buffer].data();
    uint32_t ends[2] = {chunk.left_begin, chunk.right_begin};
    Box4 left, right;
    // The last centre seen on either side, so that both boxes are extended without a branch. NaN,
    // as the first of two, extends nothing.
    Float4 left_center = Float4{} + std::numeric_limits<float>::quiet_NaN();
    Float4 right_center = left_center;
    const SideTest goes_right(binning, split);
    for (uint32_t i = chunk.range.begin; i < chunk.range.end; ++i) {
      const Int4 is_right = goes_right(from[i]);
      const Float4 center = half_center_of(from[i].box());
      left_center = is_right ? left_center : center;
      right_center = is_right ? center : right_center;
      left = {min_of(left_center, left.min), max_of(left_center, left.max)};
      right = {min_of(right_center, right.min), max_of(right_center, right.max)};
      to[ends[is_right[0] & 1]++] = from[i];
    }
    chunk.half_centers = {left, right};
  }

  // Where bins cannot tell centres apart, or cannot keep the leaf size in reach.
  std::array<Part, 2> halve(const Part& part) {
    const Box half_centers = part.half_centers.box();
    const int axis = half_centers.longest_axis();
    const uint32_t middle = part.range.begin + part.range.count() / 2;
    Reference* const first = buffers_[part.buffer].data();
    if (half_centers.min != half_centers.max) {
      const auto key = [&](const Reference& reference) {
        return std::tuple(half_center_of(reference.box())[axis], reference.primitive);
      };
      std::nth_element(first + part.range.begin, first + middle, first + part.range.end,
                       [&](const Reference& a, const Reference& b) { return key(a) < key(b); });
    }
    std::array<Part, 2> sides = empty_sides(part, middle);
    for (Part& side : sides) {
      for_each_position(side.range, progress_, [&](uint32_t i) {
        const Box4 box = first[i].box();
        side.bounds.extend(box);
        side.half_centers.extend(half_center_of(box));
      });
    }
    return sides;
  }

  static std::array<Part, 2> empty_sides(const Part& part, uint32_t middle) {
    const Part empty{part.range, part.buffer, part.depth + 1, Box4(), Box4()};
    std::array<Part, 2> sides{empty, empty};
    sides[0].range.end = sides[1].range.begin = middle;
    return sides;
  }

  bool is_leaf(const Part& part) const {
    return part.depth >= max_depth_ || part.range.count() <= static_cast<uint32_t>(leaf_size_);
  }

  std::span<const Reference> references(const Part& part) const {
    return {&buffers_[part.buffer][part.range.begin], part.range.count()};
  }

  void report_placed(uint32_t count) {
    const uint32_t placed = placed_.fetch_add(count, std::memory_order_relaxed) + count;
    progress_.set_fraction(static_cast<double>(placed) / count_);
  }

  const std::span<const Box> boxes_;
  const uint32_t count_;
  const int leaf_size_;
  const int max_depth_;
  const BuildSettings settings_;
  const BlockCount block_count_;
  Progress& progress_;
  float scale_ = 1;
  std::unique_ptr<SmallSweep::Costs> small_costs_;
  std::array<ScratchArray<Reference>, 2> buffers_;  // each split moves from one to the other
  uint32_t* primitives_ = nullptr;                  // BvhTree::primitives
  std::atomic<uint32_t> placed_{0};
};

}  // namespace

BvhTree build_binned_sah(const Primitives& primitives, const BuildSettings& settings,
                         Progress& progress) {
  return BinnedBuild(primitives, settings, progress).build();
}

}  // namespace tracer
