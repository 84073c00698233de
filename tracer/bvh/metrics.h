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
  double sah_cost =
      0;  // [MacDonald 1990], traversal_cost 1 a node, intersection_cost 1 a primitive
  size_t bytes = 0;
};

TreeMetrics measure(const BvhTree& tree);

}  // namespace tracer
