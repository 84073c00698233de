// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "tracer/bvh/tree.h"

namespace tracer {

struct TreeMetrics {
  uint32_t node_count = 0;  // leaves included
  uint32_t leaf_count = 0;
  int depth = 0;  // of the deepest leaf; the root has depth 0
  uint32_t largest_leaf = 0;
  // [MacDonald 1990]: 1 for each inner node and for each primitive of a leaf, times the chance that
  // a ray through the root meets the node.
  double sah_cost = 0;
  size_t bytes = 0;
};

TreeMetrics measure(const BvhTree& tree);

}  // namespace tracer
