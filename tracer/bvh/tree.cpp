// SPDX-License-Identifier: MIT
#include "tracer/bvh/tree.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tracer {
namespace {

std::string node_name(uint32_t node) {
  return "node " + std::to_string(node);
}

std::string primitive_name(uint32_t primitive) {
  return "primitive " + std::to_string(primitive);
}

class Validation {
 public:
  Validation(const BvhTree& tree, const Primitives& primitives, int max_depth)
      : tree_(tree),
        primitives_(primitives),
        boxes_(primitives.boxes),
        max_depth_(max_depth),
        node_reached_(tree.nodes.size()),
        leaves_of_(boxes_.size()) {}

  std::string fault() {
    if (primitives_.slice ? tree_.primitives.size() < boxes_.size()
                          : tree_.primitives.size() != boxes_.size()) {
      return "not one primitive a box";
    }
    if (boxes_.empty()) return tree_.nodes.empty() ? "" : "nodes without primitives";
    if (tree_.nodes.empty()) return "primitives without nodes";
    visit(0, 0);
    for (size_t i = 0; i < node_reached_.size() && fault_.empty(); ++i) {
      if (!node_reached_[i]) fail(node_name(static_cast<uint32_t>(i)) + " is not reached");
    }
    for (uint32_t i = 0; i < leaves_of_.size() && fault_.empty(); ++i) {
      if (leaves_of_[i].empty()) fail(primitive_name(i) + " is not reached");
    }
    for (uint32_t i = 0; i < leaves_of_.size() && fault_.empty() && primitives_.slice; ++i) {
      if (!is_covered(i, boxes_[i])) fail("the leaves of " + primitive_name(i) + " leave a gap");
    }
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
    if (node.first != std::exchange(leaf_begin_, node.first + node.count)) {
      return fail("a leaf's primitives do not follow those of the leaf before it");
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const uint32_t primitive = tree_.primitives[i];
      if (primitive >= boxes_.size()) return fail("no such primitive");
      std::vector<const BvhNode*>& leaves = leaves_of_[primitive];
      if (!leaves.empty() && (!primitives_.slice || leaves.back() == &node)) {
        return fail(primitive_name(primitive) + " is there twice");
      }
      leaves.push_back(&node);
      bounds.extend(boxes_[primitive]);
    }
    // Parts are as large as their leaf says, but no larger than the whole.
    return primitives_.slice && bounds.contains(node.bounds) ? node.bounds : bounds;
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

  // Whether every part of the primitive in `part` is in one of its leaves. What no leaf holds is
  // cut along a leaf's face, until nothing or no more than rounding is left.
  bool is_covered(uint32_t primitive, const Box& part) const {
    for (const BvhNode* leaf : leaves_of_[primitive]) {
      if (leaf->bounds.contains(part)) return true;
    }
    for (const BvhNode* leaf : leaves_of_[primitive]) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const float plane : {leaf->bounds.min[axis], leaf->bounds.max[axis]}) {
          if (!(part.min[axis] < plane && plane < part.max[axis])) continue;
          std::array<Box4, 2> halves;
          primitives_.slice(primitive, axis, {&plane, 1}, halves);
          return std::ranges::all_of(halves, [&](const Box4& half) {
            const Box rest = intersection(half, Box4(part)).box();
            return rest.is_empty() || is_covered(primitive, rest);
          });
        }
      }
    }
    return is_rounding(part, boxes_[primitive]);
  }

  // Whether the part is a sliver no thicker than what slices may be too large by.
  static bool is_rounding(const Box& part, const Box& whole) {
    const double slack = 0x1p-17 * std::max(max_abs(Vec3d(whole.min)), max_abs(Vec3d(whole.max)));
    for (int axis = 0; axis < 3; ++axis) {
      if (part.extent()[axis] <= slack && whole.extent()[axis] > 2 * slack) return true;
    }
    return false;
  }

  Box fail(std::string fault) {
    fault_ = std::move(fault);
    return {};
  }

  const BvhTree& tree_;
  const Primitives& primitives_;
  const std::span<const Box> boxes_;
  const int max_depth_;
  std::vector<bool> node_reached_;
  std::vector<std::vector<const BvhNode*>> leaves_of_;  // by primitive
  uint32_t leaf_begin_ = 0;                             // of the next leaf's primitives
  std::string fault_;
};

}  // namespace

void refit(BvhTree& tree) {
  for (size_t i = tree.nodes.size(); i-- > 0;) {
    BvhNode& node = tree.nodes[i];
    if (node.is_leaf()) continue;
    node.bounds = tree.nodes[node.first].bounds;
    node.bounds.extend(tree.nodes[node.first + 1].bounds);
  }
}

std::string validate(const BvhTree& tree, const Primitives& primitives, int max_depth) {
  return Validation(tree, primitives, max_depth).fault();
}

}  // namespace tracer
