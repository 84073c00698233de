// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tracer/base/large_vector.h"
#include "tracer/bvh/primitives.h"
#include "tracer/geometry/box.h"

namespace tracer {

/// 32 bytes. A leaf holds `count` > 0 primitives, BvhTree::primitives[first, first + count). An
/// inner node has count 0 and its children at nodes[first] and nodes[first + 1].
struct BvhNode {
  Box bounds;  // 24 bytes: of all primitives below, or of the parts of them that belong here
  uint32_t first = 0;
  uint32_t count = 0;

  bool is_leaf() const { return count > 0; }
};
static_assert(sizeof(BvhNode) == 32);

/// A binary tree over primitives. nodes[0] is the root; no primitives, no nodes. Children come
/// after their parent, in pairs, and the primitives below a node are side by side, those of the
/// left child first. A primitive that was cut is in several leaves: the part of it in each leaf's
/// bounds belongs there.
struct BvhTree {
  LargeVector<BvhNode> nodes;
  std::vector<uint32_t> primitives;

  size_t bytes() const {
    return nodes.size() * sizeof(BvhNode) + primitives.size() * sizeof(uint32_t);
  }
};

/// Makes the bounds of each inner node those of its children, from the leaves upward.
void refit(BvhTree& tree);

/// Empty when every invariant of the tree over `primitives` holds, else the first that does not, in
/// words: every primitive in a leaf, in the order of the leaves, bounds those of what is below bit
/// for bit, no node reached twice, no leaf deeper than `max_depth` (the root has depth 0). Where
/// primitives can be cut, a leaf's bounds may hold parts of them, and all leaves together must
/// cover each primitive.
std::string validate(const BvhTree& tree, const Primitives& primitives, int max_depth);

}  // namespace tracer
