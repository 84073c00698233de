// SPDX-License-Identifier: MIT
// What top-down builders share: recursion, leaves, the order of nodes, threads and progress.
#pragma once

#include <algorithm>
#include <atomic>
#include <vector>

#include "tracer/base/parallel.h"
#include "tracer/base/progress.h"
#include "tracer/bvh/build/tree_part.h"
#include "tracer/bvh/build_settings.h"

namespace tracer {

/// Positions [begin, end) in a builder's own order of the primitives.
struct PrimitiveRange {
  uint32_t begin;
  uint32_t end;

  uint32_t count() const { return end - begin; }
};

/// Ranges above this size are split in parallel: by the range alone, as the order of nodes depends
/// on it.
inline constexpr uint32_t task_size = 1024;

/// Calls f(i) for each i in the range, looking at the stop flag every few thousand.
template <class F>
void for_each_position(PrimitiveRange range, const Progress& progress, F&& f) {
  constexpr uint32_t positions_a_look = 8192;
  for (uint32_t begin = range.begin; begin < range.end; begin += positions_a_look) {
    progress.throw_if_stopped();
    const uint32_t end = begin + std::min(positions_a_look, range.end - begin);
    for (uint32_t i = begin; i < end; ++i) f(i);
  }
}

/// Calls f() and g(), at the same time where there are threads. Throws Cancelled where either was
/// left out.
template <class F, class G>
void do_both(F&& f, G&& g) {
  bool is_f_done = false, is_g_done = false;
  parallel_invoke([&] { f(), is_f_done = true; }, [&] { g(), is_g_done = true; });
  // Tasks are skipped, without an exception here, once one elsewhere has thrown.
  if (!is_f_done || !is_g_done) throw Cancelled{};
}

/// Gives `part` two below it: calls build_left(part) and build_right(part) as do_both() does.
template <class F, class G>
void build_both(TreePart& part, F&& build_left, G&& build_right) {
  part.left = std::make_unique<TreePart>();
  part.right = std::make_unique<TreePart>();
  do_both([&] { build_left(*part.left); }, [&] { build_right(*part.right); });
}

/// Room for most subtrees that one task makes.
inline size_t likely_node_count(uint32_t primitive_count, int leaf_size) {
  return 2 + 4 * std::min(primitive_count, 2 * task_size) / static_cast<uint32_t>(leaf_size);
}

/// Splits ranges until they are small or deep enough. A Splitter has, callable at the same time
/// for disjoint ranges:
///   Box bounds(PrimitiveRange);
///   uint32_t split(PrimitiveRange, const Box& bounds, int levels_left);
///       reorders the range of two or more and returns the first position of the right child, with
///       at least one primitive on either side; levels_left >= 1 are allowed below the range;
/// and once all is split:
///   std::vector<uint32_t> take_order();
///       the primitive at each position.
template <class Splitter>
class Subdivision {
 public:
  Subdivision(Splitter& splitter, uint32_t primitive_count, const BuildSettings& settings,
              Progress& progress)
      : splitter_(splitter),
        primitive_count_(primitive_count),
        leaf_size_(settings.leaf_size),
        max_depth_(std::min(settings.max_depth, max_tree_depth)),
        progress_(progress) {}

  BvhTree build() {
    BvhTree tree;
    if (primitive_count_ > 0) {
      TreePart top;
      build_part({0, primitive_count_}, 0, top);
      tree.nodes = join(top).nodes;
    }
    tree.primitives = splitter_.take_order();
    return tree;
  }

 private:
  void build_part(PrimitiveRange range, int depth, TreePart& part) {
    if (range.count() <= task_size || is_leaf(range, depth)) {
      progress_.throw_if_stopped();
      part.nodes.resize(1);
      subdivide(part.nodes, 0, range, depth);
      report_placed(range.count());
      return;
    }
    const Box bounds = splitter_.bounds(range);
    part.nodes = {{bounds}};
    const uint32_t middle = splitter_.split(range, bounds, max_depth_ - depth);
    build_both(
        part,
        [&](TreePart& left) {
          build_part({range.begin, middle}, depth + 1, left);
        },
        [&](TreePart& right) {
          build_part({middle, range.end}, depth + 1, right);
        });
  }

  // Turns nodes[node] into the root over the range and appends what is below it.
  void subdivide(std::vector<BvhNode>& nodes, uint32_t node, PrimitiveRange range, int depth) {
    const Box bounds = splitter_.bounds(range);
    if (is_leaf(range, depth)) {
      nodes[node] = {bounds, range.begin, range.count()};
      return;
    }
    const uint32_t middle = splitter_.split(range, bounds, max_depth_ - depth);
    const auto children = static_cast<uint32_t>(nodes.size());
    nodes[node] = {bounds, children, 0};
    nodes.resize(nodes.size() + 2);
    subdivide(nodes, children, {range.begin, middle}, depth + 1);
    subdivide(nodes, children + 1, {middle, range.end}, depth + 1);
  }

  bool is_leaf(PrimitiveRange range, int depth) const {
    return depth >= max_depth_ || range.count() <= static_cast<uint32_t>(std::max(leaf_size_, 1));
  }

  void report_placed(uint32_t count) {
    const uint32_t placed = placed_.fetch_add(count, std::memory_order_relaxed) + count;
    progress_.set_fraction(static_cast<double>(placed) / primitive_count_);
  }

  Splitter& splitter_;
  const uint32_t primitive_count_;
  int leaf_size_;
  int max_depth_;
  Progress& progress_;
  std::atomic<uint32_t> placed_{0};
};

}  // namespace tracer
