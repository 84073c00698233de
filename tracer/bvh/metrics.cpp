// SPDX-License-Identifier: MIT
#include "tracer/bvh/metrics.h"

#include <algorithm>

namespace tracer {
namespace {

void count_at(std::vector<uint32_t>& histogram, size_t place) {
  if (histogram.size() <= place) histogram.resize(place + 1);
  ++histogram[place];
}

}  // namespace

TreeMetrics measure(const BvhTree& tree, const SahCosts& costs) {
  TreeMetrics metrics;
  metrics.node_count = static_cast<uint32_t>(tree.nodes.size());
  metrics.reference_count = static_cast<uint32_t>(tree.primitives.size());
  metrics.bytes = tree.bytes();
  metrics.costs = costs;
  if (tree.nodes.empty()) return metrics;

  const double root_area = tree.nodes[0].bounds.half_area();
  std::vector<uint8_t> depths(tree.nodes.size());
  for (size_t i = 0; i < tree.nodes.size(); ++i) {
    const BvhNode& node = tree.nodes[i];
    // A root without area is a line or a point: what hits it hits all of it.
    const double probability = root_area > 0 ? node.bounds.half_area() / root_area : 1;
    metrics.sah_cost += probability * costs.of(node);
    if (node.is_leaf()) {
      ++metrics.leaf_count;
      metrics.largest_leaf = std::max(metrics.largest_leaf, node.count);
      count_at(metrics.leaves_at_depth, depths[i]);
      count_at(metrics.leaves_of_size, std::min(node.count, largest_told_leaf));
    } else {
      depths[node.first] = depths[node.first + 1] = static_cast<uint8_t>(depths[i] + 1);
    }
  }
  metrics.depth = static_cast<int>(metrics.leaves_at_depth.size()) - 1;
  return metrics;
}

}  // namespace tracer
