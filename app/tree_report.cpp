// SPDX-License-Identifier: MIT
#include "app/tree_report.h"

namespace app {

void add_tree(nlohmann::ordered_json& json, const tracer::TreeMetrics& metrics,
              const tracer::TreeQuality& quality, size_t bytes) {
  json["nodes"] = metrics.node_count;
  json["leaves"] = metrics.leaf_count;
  json["references"] = metrics.reference_count;
  json["depth"] = metrics.depth;
  json["largest_leaf"] = metrics.largest_leaf;
  json["leaves_at_depth"] = metrics.leaves_at_depth;
  json["leaves_of_size"] = metrics.leaves_of_size;
  json["sah_cost"] = metrics.sah_cost;
  json["sah_traversal_cost"] = metrics.costs.traversal;
  json["sah_intersection_cost"] = metrics.costs.intersection;
  json["epo"] = quality.epo.value;
  json["epo_sampled_triangles"] = quality.epo.sample_count;
  json["lcv"] = quality.lcv.value;
  json["lcv_rays"] = quality.lcv.ray_count;
  json["tree_bytes"] = bytes;
}

}  // namespace app
