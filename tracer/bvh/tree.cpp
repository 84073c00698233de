// SPDX-License-Identifier: MIT
#include "tracer/bvh/tree.h"

namespace tracer {
namespace {

std::string node_name(uint32_t node) {
  return "node " + std::to_string(node);
}

class Validation {
 public:
  Validation(const BvhTree& tree, const std::vector<Box>& boxes, int max_depth)
      : tree_(tree),
        boxes_(boxes),
        max_depth_(max_depth),
        node_reached_(tree.nodes.size()),
        primitive_reached_(boxes.size()) {}

  std::string fault() {
    if (tree_.primitives.size() != boxes_.size()) return "not one primitive a box";
    if (boxes_.empty()) return tree_.nodes.empty() ? "" : "nodes without primitives";
    if (tree_.nodes.empty()) return "primitives without nodes";
    visit(0, 0);
    if (fault_.empty()) require_all(node_reached_, "node");
    if (fault_.empty()) require_all(primitive_reached_, "primitive");
    return fault_;
  }

 private:
  // Returns the bounds of the primitives below; recursion ends at max_depth_.
  Box visit(uint32_t node_index, int depth) {
    const BvhNode& node = tree_.nodes[node_index];
    if (node_reached_[node_index]) return fail(node_name(node_index) + " is reached twice");
    node_reached_[node_index] = true;
    if (depth > max_depth_) return fail(node_name(node_index) + " is too deep");
    const Box below = node.is_leaf() ? visit_leaf(node) : visit_children(node_index, depth);
    if (!fault_.empty()) return below;
    if (below.min != node.bounds.min || below.max != node.bounds.max) {
      return fail(node_name(node_index) + " has other bounds than what is below it");
    }
    return below;
  }

  Box visit_leaf(const BvhNode& node) {
    Box bounds;
    if (uint64_t{node.first} + node.count > tree_.primitives.size()) {
      return fail("a leaf reaches beyond the primitives");
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const uint32_t primitive = tree_.primitives[i];
      if (primitive >= boxes_.size()) return fail("no such primitive");
      if (primitive_reached_[primitive]) {
        return fail("primitive " + std::to_string(primitive) + " is in two leaves");
      }
      primitive_reached_[primitive] = true;
      bounds.extend(boxes_[primitive]);
    }
    return bounds;
  }

  Box visit_children(uint32_t node_index, int depth) {
    const uint32_t first = tree_.nodes[node_index].first;
    if (first <= node_index || uint64_t{first} + 1 >= tree_.nodes.size()) {
      return fail(node_name(node_index) + " has its children out of place");
    }
    Box bounds = visit(first, depth + 1);
    if (fault_.empty()) bounds.extend(visit(first + 1, depth + 1));
    return bounds;
  }

  void require_all(const std::vector<bool>& reached, const char* what) {
    for (size_t i = 0; i < reached.size(); ++i) {
      if (!reached[i]) {
        fail(std::string(what) + ' ' + std::to_string(i) + " is not reached");
        return;
      }
    }
  }

  Box fail(std::string fault) {
    fault_ = std::move(fault);
    return {};
  }

  const BvhTree& tree_;
  const std::vector<Box>& boxes_;
  const int max_depth_;
  std::vector<bool> node_reached_;
  std::vector<bool> primitive_reached_;
  std::string fault_;
};

}  // namespace

std::string validate(const BvhTree& tree, const std::vector<Box>& boxes, int max_depth) {
  return Validation(tree, boxes, max_depth).fault();
}

}  // namespace tracer
