// SPDX-License-Identifier: MIT
// Which nodes of a binary tree become nodes of a wide one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "tracer/base/progress.h"
#include "tracer/base/scratch_array.h"
#include "tracer/bvh/build/subdivide.h"
#include "tracer/bvh/tree.h"

namespace tracer {

/// The collapse of a binary tree whose surface area cost is least [Wald 2008]: a dynamic program
/// over forests, of what a subtree costs as at most k children of a wide node.
class Collapse {
 public:
  static constexpr size_t max_width = 16;

  /// A subtree of the binary tree as one child of a wide node. 32 bytes.
  struct Part {
    PrimitiveRange range;  // of BvhTree::primitives
    uint32_t node_count;   // of the wide tree, its root included; 0 for a leaf
    uint32_t block_count;
    uint8_t child_count;  // of its root; not set for a leaf, nor is the next
    // [k - 2]: of k children, how many the left child becomes; 0 where it is cheaper to stay one.
    std::array<uint8_t, max_width - 1> left_shares;

    bool is_leaf() const { return node_count == 0; }
  };

  /// Nodes of the binary tree, in the order of their primitives.
  struct Children {
    std::array<uint32_t, max_width> nodes;
    size_t count = 0;

    const uint32_t* begin() const { return nodes.data(); }
    const uint32_t* end() const { return nodes.data() + count; }
  };

  /// `tree` is not empty; `width` is at most max_width and also that of a block. Subtrees of at
  /// most `width` primitives become one block, but for large flat parts, which rays
  /// that leave them do not meet. Throws Cancelled.
  Collapse(const BvhTree& tree, uint32_t width, const Progress& progress);

  /// Of the root, and of every node that is a child of a wide node.
  const Part& part(uint32_t node) const { return parts_[node]; }
  Children children_of(uint32_t node) const;
  /// Nodes and blocks that a random line through the root meets.
  float expected_steps() const { return expected_steps_; }

 private:
  struct Forest;

  void plan(uint32_t node, PrimitiveRange range, Forest& forest);
  void plan_children(uint32_t node, PrimitiveRange range, Forest& left_forest,
                     Forest& right_forest);
  void join(const Forest& left, const Forest& right, Part& part, Forest& forest) const;
  void stay_one_where_cheaper(Part& part, Forest& forest) const;
  bool has_large_flat_part(uint32_t node) const;
  float cost_of_block(uint32_t node) const;
  void add_children(uint32_t node, size_t child_count, Children& children) const;
  float area(uint32_t node) const;
  uint32_t first_primitive(uint32_t node) const;

  const BvhTree& tree_;
  const uint32_t width_;
  const Progress& progress_;
  const double area_scale_;  // so that no area overflows
  ScratchArray<Part> parts_;
  float expected_steps_;
};

}  // namespace tracer
