// SPDX-License-Identifier: MIT
#include "tracer/bvh/tree.h"

#include <numeric>

#include <gtest/gtest.h>

#include "tracer/bvh/build.h"
#include "tracer/bvh/metrics.h"

namespace tracer {
namespace {

std::vector<Box> four_boxes() {
  std::vector<Box> boxes;
  for (const float x : {0.0f, 1.0f, 2.0f, 3.0f}) boxes.push_back({Vec3f(x), Vec3f(x + 1)});
  return boxes;
}

BvhTree tree_of_four() {
  Progress progress;
  return builders()[0].build(four_boxes(), {.max_depth = 30, .leaf_size = 1}, progress);
}

std::string fault_of(const BvhTree& tree, int max_depth = 30) {
  return validate(tree, four_boxes(), max_depth);
}

TEST(Validate, finds_nothing_wrong_with_a_built_tree) {
  EXPECT_EQ(fault_of(tree_of_four()), "");
  EXPECT_EQ(validate({}, {}, 30), "");
}

TEST(Validate, finds_bounds_that_are_too_small_or_too_large) {
  for (size_t node = 0; node < 7; ++node) {
    BvhTree tree = tree_of_four();
    tree.nodes[node].bounds.max.x -= 0.5f;
    EXPECT_NE(fault_of(tree), "") << node;
    tree = tree_of_four();
    tree.nodes[node].bounds.min.y -= 0.5f;
    EXPECT_NE(fault_of(tree), "") << node;
  }
}

TEST(Validate, finds_primitives_that_are_missing_or_in_two_leaves) {
  BvhTree tree = tree_of_four();
  tree.primitives[0] = tree.primitives[1];
  EXPECT_NE(fault_of(tree), "");
  tree = tree_of_four();
  tree.primitives.pop_back();
  EXPECT_NE(fault_of(tree), "");
  EXPECT_NE(fault_of({}), "");
}

TEST(Validate, finds_nodes_reached_twice_or_never) {
  BvhTree tree = tree_of_four();
  tree.nodes[1].first = tree.nodes[2].first;
  EXPECT_NE(fault_of(tree), "");
  tree = tree_of_four();
  tree.nodes.push_back(tree.nodes.back());
  EXPECT_NE(fault_of(tree), "");
}

TEST(Validate, finds_children_and_primitives_out_of_range) {
  BvhTree tree = tree_of_four();
  tree.nodes[2].first = 6;
  EXPECT_NE(fault_of(tree), "");
  tree = tree_of_four();
  tree.nodes[2].first = 0;
  EXPECT_NE(fault_of(tree), "");
  tree = tree_of_four();
  tree.primitives[2] = 4;
  EXPECT_NE(fault_of(tree), "");
  tree = tree_of_four();
  tree.nodes.back().count = 2;
  EXPECT_NE(fault_of(tree), "");
}

TEST(Validate, finds_primitives_out_of_the_order_of_the_leaves) {
  BvhTree tree = tree_of_four();
  std::swap(tree.nodes[1], tree.nodes[2]);
  EXPECT_NE(fault_of(tree), "");
}

TEST(Validate, finds_leaves_that_are_too_deep) {
  EXPECT_EQ(fault_of(tree_of_four(), 2), "");
  EXPECT_NE(fault_of(tree_of_four(), 1), "");
}

TEST(Metrics, of_four_cubes_in_a_diagonal_are_those_counted_by_hand) {
  const TreeMetrics metrics = measure(tree_of_four());
  EXPECT_EQ(metrics.node_count, 7u);
  EXPECT_EQ(metrics.leaf_count, 4u);
  EXPECT_EQ(metrics.depth, 2);
  EXPECT_EQ(metrics.largest_leaf, 1u);
  // Half areas: root 48, its children 12 each, leaves 3 each.
  EXPECT_DOUBLE_EQ(metrics.sah_cost, (48 + 2 * 12 + 4 * 3) / 48.0);
  EXPECT_EQ(metrics.bytes, 7 * 32 + 4 * 4u);
}

TEST(Metrics, sah_cost_is_linear_in_its_constants) {
  // Half areas: root 48, its children 12 each, leaves 3 each.
  const TreeMetrics metrics = measure(tree_of_four(), {.traversal = 2, .intersection = 5});
  EXPECT_DOUBLE_EQ(metrics.sah_cost, (2 * (48 + 2 * 12) + 5 * 4 * 3) / 48.0);
  EXPECT_EQ(metrics.costs.traversal, 2);
  EXPECT_EQ(metrics.costs.intersection, 5);
}

TEST(Metrics, histograms_count_every_leaf_once) {
  for (const Builder& builder : builders()) {
    for (const int max_depth : {1, 4, 30}) {
      std::vector<Box> boxes;
      for (int i = 0; i < 300; ++i) boxes.push_back({Vec3f(i * i), Vec3f(i * i + 1)});
      Progress progress;
      const TreeMetrics metrics =
          measure(builder.build(boxes, {.max_depth = max_depth, .leaf_size = 3}, progress));
      ASSERT_EQ(metrics.leaves_at_depth.size(), static_cast<size_t>(metrics.depth) + 1);
      ASSERT_EQ(metrics.leaves_of_size.size(),
                std::min(metrics.largest_leaf, largest_told_leaf) + 1);
      const auto sum = [](const std::vector<uint32_t>& counts) {
        return std::accumulate(counts.begin(), counts.end(), 0u);
      };
      EXPECT_EQ(sum(metrics.leaves_at_depth), metrics.leaf_count);
      EXPECT_EQ(sum(metrics.leaves_of_size), metrics.leaf_count);
      EXPECT_EQ(metrics.leaves_of_size[0], 0u);
      EXPECT_EQ(metrics.reference_count, boxes.size());
    }
  }
}

TEST(Metrics, histograms_of_four_cubes_are_those_counted_by_hand) {
  const TreeMetrics metrics = measure(tree_of_four());
  EXPECT_EQ(metrics.leaves_at_depth, (std::vector<uint32_t>{0, 0, 4}));
  EXPECT_EQ(metrics.leaves_of_size, (std::vector<uint32_t>{0, 4}));
}

TEST(Metrics, a_primitive_in_two_leaves_counts_in_both) {
  BvhTree tree;
  tree.nodes = {{{Vec3f(0), Vec3f(2, 1, 1)}, 1, 0},
                {{Vec3f(0), Vec3f(1)}, 0, 1},
                {{Vec3f(1, 0, 0), Vec3f(2, 1, 1)}, 1, 2}};
  tree.primitives = {0, 0, 1};
  const TreeMetrics metrics = measure(tree);
  EXPECT_EQ(metrics.reference_count, 3u);
  EXPECT_DOUBLE_EQ(metrics.sah_cost, (5 + 3 + 2 * 3) / 5.0);
  EXPECT_EQ(metrics.bytes, 3 * 32 + 3 * 4u);
}

TEST(Metrics, of_no_tree_are_zero) {
  EXPECT_EQ(measure({}).node_count, 0u);
  EXPECT_EQ(measure({}).sah_cost, 0);
}

TEST(Metrics, of_a_tree_without_area_are_finite) {
  const std::vector<Box> boxes(100, Box{Vec3f(1), Vec3f(1)});
  Progress progress;
  EXPECT_TRUE(std::isfinite(measure(builders()[0].build(boxes, {}, progress)).sah_cost));
}

}  // namespace
}  // namespace tracer
