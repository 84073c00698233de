// SPDX-License-Identifier: MIT
#include "tracer/bvh/metrics.h"

#include <algorithm>

namespace tracer {

TreeMetrics measure(const BvhTree& tree) {
  TreeMetrics metrics;
  metrics.node_count = static_cast<uint32_t>(tree.nodes.size());
  metrics.bytes = tree.nodes.size() * sizeof(BvhNode) + tree.primitives.size() * sizeof(uint32_t);
  if (tree.nodes.empty()) return metrics;

  const double root_area = tree.nodes[0].bounds.half_area();
  std::vector<int> depths(tree.nodes.size());
  for (size_t i = 0; i < tree.nodes.size(); ++i) {
    const BvhNode& node = tree.nodes[i];
    // A root without area is a line or a point: what hits it hits all of it.
    const double probability = root_area > 0 ? node.bounds.half_area() / root_area : 1;
    metrics.depth = std::max(metrics.depth, depths[i]);
    if (node.is_leaf()) {
      ++metrics.leaf_count;
      metrics.largest_leaf = std::max(metrics.largest_leaf, node.count);
      metrics.sah_cost += probability * node.count;
    } else {
      depths[node.first] = depths[node.first + 1] = depths[i] + 1;
      metrics.sah_cost += probability;
    }
  }
  return metrics;
}

}  // namespace tracer
