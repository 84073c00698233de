// SPDX-License-Identifier: MIT
// What tasks build apart, joined into one tree.
#pragma once

#include <memory>
#include <vector>

#include "tracer/bvh/tree.h"

namespace tracer {

/// A subtree of its own: nodes[0] is the root, and indices count from its own first node and
/// primitive. With `left` and `right` it is one inner node above two others.
struct TreePart {
  std::vector<BvhNode> nodes;
  std::vector<uint32_t> primitives;
  std::unique_ptr<TreePart> left, right;
};

/// Parts without primitives of their own count from the tree's first one. Primitives are in the
/// order of the leaves, those below any node side by side.
BvhTree join(const TreePart& root);

}  // namespace tracer
