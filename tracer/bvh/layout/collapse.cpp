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
// Of a block whose box is flat, as rays that leave it do not meet it.
constexpr float flat_block_cost = 0.75f;

bool is_flat(const Box& box) {
  return box.min.x == box.max.x || box.min.y == box.max.y || box.min.z == box.max.z;
}

double square(double x) {
  return x * x;
}

}  // namespace

/// What a subtree costs as at most k children of a wide node, at [k - 1], and the wide nodes and
/// blocks below and among these.
struct Collapse::Forest {
  size_t most_children;  // more than these gain nothing
  std::array<float, max_width> costs;
  std::array<uint32_t, max_width> node_counts;
  std::array<uint32_t, max_width> block_counts;
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
  const bool is_leaf = tree_.nodes[node].is_leaf();
  if (is_leaf || range.count() <= width_) {
    part.node_count = 0;
    part.block_count = (range.count() + width_ - 1) / width_;
    forest.most_children = 1;
    forest.costs[0] = cost_of_block(node) * static_cast<float>(part.block_count);
    forest.node_counts[0] = 0;
    forest.block_counts[0] = part.block_count;
    // Else a split of what fits into one block gains nothing and costs memory.
    if (is_leaf || !has_large_flat_part(node)) return;
    Forest left_forest, right_forest;
    plan_children(node, range, left_forest, right_forest);
    join(left_forest, right_forest, part, forest);
  } else {
    Forest left_forest, right_forest;
    plan_children(node, range, left_forest, right_forest);
    join(left_forest, right_forest, part, forest);
    const size_t most = forest.most_children;
    part.child_count = static_cast<uint8_t>(most);
    part.node_count = 1 + forest.node_counts[most - 1];
    part.block_count = forest.block_counts[most - 1];
    forest.costs[0] = area(node) * node_cost + forest.costs[most - 1];
    forest.node_counts[0] = part.node_count;
    forest.block_counts[0] = part.block_count;
  }
  stay_one_where_cheaper(part, forest);
}

void Collapse::plan_children(uint32_t node, PrimitiveRange range, Forest& left_forest,
                             Forest& right_forest) {
  const uint32_t left = tree_.nodes[node].first;
  const uint32_t middle = first_primitive(left + 1);
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
}

/// For 2 children and more.
void Collapse::join(const Forest& left, const Forest& right, Part& part, Forest& forest) const {
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
    forest.block_counts[k - 1] = left.block_counts[best - 1] + right.block_counts[k - best - 1];
    part.left_shares[k - 2] = static_cast<uint8_t>(best);
  }
  forest.most_children = most;
}

void Collapse::stay_one_where_cheaper(Part& part, Forest& forest) const {
  for (size_t k = 2; k <= forest.most_children && forest.costs[0] < forest.costs[k - 1]; ++k) {
    forest.costs[k - 1] = forest.costs[0];
    forest.node_counts[k - 1] = forest.node_counts[0];
    forest.block_counts[k - 1] = forest.block_counts[0];
    part.left_shares[k - 2] = 0;
  }
}

bool Collapse::has_large_flat_part(uint32_t node) const {
  if (is_flat(tree_.nodes[node].bounds)) return false;
  const float least = 0.25f * area(node);
  while (!tree_.nodes[node].is_leaf()) {
    const uint32_t left = tree_.nodes[node].first;
    node = area(left) > area(left + 1) ? left : left + 1;
    if (area(node) < least) return false;
    if (is_flat(tree_.nodes[node].bounds)) return true;
  }
  return false;
}

float Collapse::cost_of_block(uint32_t node) const {
  return area(node) * (is_flat(tree_.nodes[node].bounds) ? flat_block_cost : block_cost);
}

float Collapse::area(uint32_t node) const {
  return static_cast<float>(tree_.nodes[node].bounds.half_area() * area_scale_);
}

uint32_t Collapse::first_primitive(uint32_t node) const {
  while (!tree_.nodes[node].is_leaf()) node = tree_.nodes[node].first;
  return tree_.nodes[node].first;
}

}  // namespace tracer
