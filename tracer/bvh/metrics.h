// SPDX-License-Identifier: MIT
// What a look at a tree's nodes tells. What takes rays or the mesh is in quality.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracer/bvh/build_settings.h"
#include "tracer/bvh/tree.h"

namespace tracer {

/// What a ray pays, in any unit: for each inner node it enters, and for each primitive of a leaf it
/// enters.
struct SahCosts {
  double traversal = 1;
  double intersection = 1;

  double of(const BvhNode& node) const {
    return node.is_leaf() ? intersection * node.count : traversal;
  }
};

/// Leaves of this many primitives and more share the last place of TreeMetrics::leaves_of_size.
inline constexpr uint32_t largest_told_leaf = 64;

struct TreeMetrics {
  uint32_t node_count = 0;  // leaves included
  uint32_t leaf_count = 0;
  uint32_t reference_count = 0;  // primitives of all leaves; more than there are after splits
  int depth = 0;                 // of the deepest leaf; the root has depth 0
  uint32_t largest_leaf = 0;
  std::vector<uint32_t> leaves_at_depth;  // [0, depth]
  std::vector<uint32_t> leaves_of_size;   // [0, min(largest_leaf, largest_told_leaf)]
  SahCosts costs;
  // [MacDonald 1990]: what a ray through the root pays, as it would be if nothing stopped it.
  double sah_cost = 0;
  size_t bytes = 0;  // of the binary form
};

inline SahCosts sah_costs(const BuildSettings& settings) {
  return {settings.traversal_cost, settings.intersection_cost};
}

TreeMetrics measure(const BvhTree& tree, const SahCosts& costs = {});

}  // namespace tracer
