// SPDX-License-Identifier: MIT
#include "tracer/bvh/layout/collapse.h"

#include <algorithm>

#include "tracer/base/parallel.h"
#include "tracer/bvh/build/split_cost.h"

namespace tracer {
namespace {

// Relative times of a node's boxes and of a block's triangles, measured.
constexpr float node_cost = 1.0f;
constexpr float block_cost = 1.0f;

double square(double x) {
  return x * x;
}

}  // namespace

/// What a subtree costs as at most k children of a wide node, at [k - 1], and the wide nodes below
/// and among these.
struct Collapse::Forest {
  size_t most_children;  // more than these gain nothing
  std::array<float, max_width> costs;
  std::array<uint32_t, max_width> node_counts;
};

Collapse::Collapse(const BvhTree& tree, uint32_t width, const Progress& progress)
    : tree_(tree),
      width_(width),
      progress_(progress),
      area_scale_(square(unit_scale(tree.nodes[0].bounds))),
      parts_(tree.nodes.size()) {
  Forest forest;
  plan(0, {0, static_cast<uint32_t>(tree.primitives.size())}, forest);
  expected_steps_ = area(0) > 0 ? forest.costs[0] / area(0) : 0;
}

Collapse::Children Collapse::children_of(uint32_t node) const {
  const Part& part = parts_[node];
  // A root that is a leaf becomes the one child of a node.
  if (part.is_leaf()) return {{node}, 1};
  Children children;
  add_children(node, part.child_count, children);
  return children;
}

// The subtree as at most `child_count` children.
void Collapse::add_children(uint32_t node, size_t child_count, Children& children) const {
  const size_t left_share = child_count == 1 ? 0 : parts_[node].left_shares[child_count - 2];
  if (left_share == 0) {
    children.nodes[children.count++] = node;
  } else {
    const uint32_t left = tree_.nodes[node].first;
    add_children(left, left_share, children);
    add_children(left + 1, child_count - left_share, children);
  }
}

void Collapse::plan(uint32_t node, PrimitiveRange range, Forest& forest) {
  Part& part = parts_[node];
  part.range = range;
  // What fits into one block becomes one: a split of it gains nothing and costs memory.
  if (tree_.nodes[node].is_leaf() || range.count() <= width_) {
    part.node_count = 0;
    part.block_count = (range.count() + width_ - 1) / width_;
    forest.most_children = 1;
    forest.costs[0] = area(node) * block_cost * static_cast<float>(part.block_count);
    forest.node_counts[0] = 0;
    return;
  }
  const uint32_t left = tree_.nodes[node].first;
  const uint32_t middle = first_primitive(left + 1);
  Forest left_forest, right_forest;
  const auto plan_left = [&] { plan(left, {range.begin, middle}, left_forest); };
  const auto plan_right = [&] { plan(left + 1, {middle, range.end}, right_forest); };
  if (range.count() <= task_size) {
    plan_left();
    plan_right();
  } else {
    progress_.throw_if_stopped();
    parallel_invoke(plan_left, plan_right);
    progress_.throw_if_stopped();
  }
  part.block_count = parts_[left].block_count + parts_[left + 1].block_count;
  join(left_forest, right_forest, area(node), part, forest);
}

void Collapse::join(const Forest& left, const Forest& right, float area, Part& part,
                    Forest& forest) const {
  const size_t most = std::min<size_t>(width_, left.most_children + right.most_children);
  for (size_t k = 2; k <= most; ++k) {
    size_t best = k > right.most_children ? k - right.most_children : 1;
    float least = left.costs[best - 1] + right.costs[k - best - 1];
    const size_t end = std::min(left.most_children, k - 1);
    for (size_t share = best + 1; share <= end; ++share) {
      const float cost = left.costs[share - 1] + right.costs[k - share - 1];
      best = cost < least ? share : best;
      least = cost < least ? cost : least;
    }
    forest.costs[k - 1] = least;
    forest.node_counts[k - 1] = left.node_counts[best - 1] + right.node_counts[k - best - 1];
    part.left_shares[k - 2] = static_cast<uint8_t>(best);
  }
  part.child_count = static_cast<uint8_t>(most);
  part.node_count = 1 + forest.node_counts[most - 1];
  forest.most_children = most;
  forest.costs[0] = area * node_cost + forest.costs[most - 1];
  forest.node_counts[0] = part.node_count;
  for (size_t k = 2; k <= most && forest.costs[0] < forest.costs[k - 1]; ++k) {
    forest.costs[k - 1] = forest.costs[0];
    forest.node_counts[k - 1] = forest.node_counts[0];
    part.left_shares[k - 2] = 0;
  }
}

float Collapse::area(uint32_t node) const {
  return static_cast<float>(tree_.nodes[node].bounds.half_area() * area_scale_);
}

uint32_t Collapse::first_primitive(uint32_t node) const {
  while (!tree_.nodes[node].is_leaf()) node = tree_.nodes[node].first;
  return tree_.nodes[node].first;
}

}  // namespace tracer
