// SPDX-License-Identifier: MIT
#include "tracer/bvh/layout/collapse.h"

#include <cstring>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/test_meshes.h"
#include "tracer/base/parallel.h"
#include "tracer/bvh/build.h"
#include "tracer/bvh/layout/wide_tree.h"

namespace tracer {
namespace {

BvhTree build(const char* builder, const Primitives& primitives, int leaf_size) {
  Progress progress;
  return find_builder(builder)->build(primitives, {.max_depth = 64, .leaf_size = leaf_size},
                                      progress);
}

uint32_t primitive_count(const BvhTree& tree, uint32_t node) {
  const BvhNode& root = tree.nodes[node];
  if (root.is_leaf()) return root.count;
  return primitive_count(tree, root.first) + primitive_count(tree, root.first + 1);
}

/// Tries every way to collapse a subtree.
struct Trial {
  const BvhTree& tree;
  uint32_t width;

  double area(uint32_t node) const { return tree.nodes[node].bounds.half_area(); }
  bool is_leaf(uint32_t node) const {
    return tree.nodes[node].is_leaf() || primitive_count(tree, node) <= width;
  }
  double cost_of_one(uint32_t node) const {
    if (!is_leaf(node)) return area(node) + least_split(node, width);
    return area(node) * ((primitive_count(tree, node) + width - 1) / width);
  }
  double least_cost(uint32_t node, uint32_t child_count) const {
    const double one = cost_of_one(node);
    if (child_count == 1 || is_leaf(node)) return one;
    return std::min(one, least_split(node, child_count));
  }
  double least_split(uint32_t node, uint32_t child_count) const {
    double least = std::numeric_limits<double>::infinity();
    const uint32_t left = tree.nodes[node].first;
    for (uint32_t share = 1; share < child_count; ++share) {
      least = std::min(least, least_cost(left, share) + least_cost(left + 1, child_count - share));
    }
    return least;
  }
};

/// What is found by following a collapse from its root.
struct Walk {
  double cost = 0;
  uint32_t node_count = 0;
  uint32_t block_count = 0;
  std::vector<uint32_t> order;  // of positions in BvhTree::primitives

  void visit(const Collapse& collapse, const BvhTree& tree, uint32_t node) {
    ++node_count;
    cost += tree.nodes[node].bounds.half_area();
    for (const uint32_t child : collapse.children_of(node)) {
      const Collapse::Part& part = collapse.part(child);
      if (!part.is_leaf()) {
        visit(collapse, tree, child);
        continue;
      }
      block_count += part.block_count;
      cost += part.block_count * tree.nodes[child].bounds.half_area();
      for (uint32_t i = part.range.begin; i < part.range.end; ++i) order.push_back(i);
    }
  }
};

TEST(Collapse, costs_as_little_as_the_best_of_all_ways) {
  for (const uint32_t width : {2u, 4u}) {
    for (const int leaf_size : {1, 3}) {
      const auto boxes = primitive_boxes(random_soup(26, 0.3f, 3));
      const BvhTree tree = build("morton", boxes, leaf_size);
      const Collapse collapse(tree, width, Progress());
      const Trial trial{tree, width};
      EXPECT_NEAR(collapse.expected_steps(), trial.cost_of_one(0) / trial.area(0), 1e-5);
    }
  }
}

TEST(Collapse, has_the_cost_nodes_and_blocks_that_it_says_with_every_primitive_in_order) {
  const auto boxes = primitive_boxes(random_soup(3000, 0.1f, 5));
  std::vector<uint32_t> all(boxes.size());
  std::iota(all.begin(), all.end(), 0u);
  for (const Builder& builder : builders()) {
    const BvhTree tree = build(builder.name.data(), boxes, 2);
    for (const uint32_t width : {4u, 8u, 16u}) {
      const Collapse collapse(tree, width, Progress());
      Walk walk;
      walk.visit(collapse, tree, 0);
      const double area = tree.nodes[0].bounds.half_area();
      EXPECT_NEAR(collapse.expected_steps(), walk.cost / area, 1e-4 * walk.cost / area);
      EXPECT_EQ(collapse.part(0).node_count, walk.node_count);
      EXPECT_EQ(collapse.part(0).block_count, walk.block_count);
      EXPECT_EQ(walk.order, all);
    }
  }
}

TEST(Collapse, large_flat_parts_have_blocks_of_their_own) {
  // A floor of two triangles, and small things on it.
  LargeVector<Box> boxes(2, Box{Vec3f(-50, 0, -50), Vec3f(50, 0, 50)});
  for (int i = 0; i < 20; ++i) {
    const Vec3f corner(0.1f * static_cast<float>(i), 0, 0.03f * static_cast<float>(i % 7));
    boxes.push_back({corner, corner + Vec3f(0.05f)});
  }
  for (const Builder& builder : builders()) {
    const BvhTree tree = build(builder.name.data(), boxes, 2);
    const Collapse collapse(tree, 16, Progress());
    uint32_t floor_blocks = 0;
    for (const uint32_t child : collapse.children_of(0)) {
      const Box& bounds = tree.nodes[child].bounds;
      if (bounds.max.x < 50) continue;
      ++floor_blocks;
      EXPECT_EQ(bounds.max.y, 0) << builder.name;
    }
    EXPECT_EQ(floor_blocks, 1u) << builder.name;
  }
}

TEST(Collapse, is_alike_at_every_scale) {
  const auto boxes = primitive_boxes(random_soup(2000, 0.1f, 3));
  BvhTree tree = build("binned-sah", boxes, 4);
  const BvhTree unscaled = tree;
  const Collapse reference(unscaled, 16, Progress());
  for (const float scale : {0x1p-100f, 0x1p-60f, 0x1p60f, 0x1p120f}) {
    for (size_t i = 0; i < tree.nodes.size(); ++i) {
      const Box& box = unscaled.nodes[i].bounds;
      tree.nodes[i].bounds = {scale * box.min, scale * box.max};
    }
    const Collapse collapse(tree, 16, Progress());
    EXPECT_EQ(collapse.part(0).node_count, reference.part(0).node_count) << scale;
    EXPECT_EQ(collapse.expected_steps(), reference.expected_steps()) << scale;
  }
}

TEST(Collapse, fills_its_nodes_where_nothing_has_an_area) {
  LargeVector<Box> boxes;
  for (int i = 0; i < 4096; ++i) boxes.push_back({Vec3f(i, 0, 0), Vec3f(i + 1, 0, 0)});
  const Collapse collapse(build("median", boxes, 1), 16, Progress());
  EXPECT_EQ(collapse.part(0).child_count, 16u);
  EXPECT_LE(collapse.part(0).node_count, 256u / 8);
  EXPECT_EQ(collapse.part(0).block_count, 256u);
}

TEST(WideTree, has_the_same_bytes_at_any_number_of_threads) {
  const Mesh mesh = rough_ball(100, 0.1f, 2);
  const BvhTree tree = build("morton", primitive_boxes(mesh), 4);
  const auto build_on = [&](int thread_count) {
    return with_thread_count(thread_count, [&] {
      Progress progress;
      return build_wide_tree(tree, mesh, 16, progress);
    });
  };
  const WideTree reference = build_on(1);
  ASSERT_GT(mesh.triangle_count(), 100000u);
  for (const int thread_count : {2, 5}) {
    const WideTree other = build_on(thread_count);
    const auto are_same = [](const void* a, const void* b, size_t bytes) {
      return std::memcmp(a, b, bytes) == 0;
    };
    ASSERT_EQ(other.nodes.bytes(), reference.nodes.bytes());
    ASSERT_EQ(other.block_infos.size(), reference.block_infos.size());
    EXPECT_TRUE(are_same(other.nodes.row(0), reference.nodes.row(0), other.nodes.bytes()));
    EXPECT_TRUE(are_same(other.blocks.row(0), reference.blocks.row(0), other.blocks.bytes()));
    EXPECT_TRUE(are_same(other.block_infos.data(), reference.block_infos.data(),
                         other.block_infos.size() * sizeof(WideTree::BlockInfo)));
    EXPECT_EQ(other.typical_extent, reference.typical_extent);
    EXPECT_EQ(other.expected_steps, reference.expected_steps);
  }
}

}  // namespace
}  // namespace tracer
