// SPDX-License-Identifier: MIT
#include "tracer/bvh/build/tree_part.h"

#include <algorithm>

#include "tracer/base/parallel.h"

namespace tracer {
namespace {

class Join {
 public:
  BvhTree run(const TreePart& root) {
    place(root, 0);
    tree_.nodes.resize(node_count_);
    tree_.primitives.resize(primitive_count_);
    for (const Placed& placed : inner_) tree_.nodes[placed.slot] = inner_node(placed);
    parallel_for_each_index(0, leaves_.size(), [&](size_t i) { copy(leaves_[i]); });
    return std::move(tree_);
  }

 private:
  struct Placed {
    const TreePart* part;
    uint32_t slot;   // of its root
    uint32_t below;  // of all other nodes
    uint32_t primitives;
  };

  void place(const TreePart& part, uint32_t slot) {
    const Placed placed{&part, slot, node_count_, primitive_count_};
    if (part.left) {
      node_count_ += 2;
      inner_.push_back(placed);
      place(*part.left, placed.below);
      place(*part.right, placed.below + 1);
    } else {
      node_count_ += static_cast<uint32_t>(part.nodes.size()) - 1;
      primitive_count_ += static_cast<uint32_t>(part.primitives.size());
      leaves_.push_back(placed);
    }
  }

  static BvhNode inner_node(const Placed& placed) {
    return {placed.part->nodes[0].bounds, placed.below, 0};
  }

  void copy(const Placed& placed) {
    const TreePart& part = *placed.part;
    const auto moved = [&](BvhNode node) {
      node.first += node.is_leaf() ? placed.primitives : placed.below - 1;
      return node;
    };
    tree_.nodes[placed.slot] = moved(part.nodes[0]);
    std::transform(part.nodes.begin() + 1, part.nodes.end(), tree_.nodes.begin() + placed.below,
                   moved);
    std::ranges::copy(part.primitives, tree_.primitives.begin() + placed.primitives);
  }

  BvhTree tree_;
  std::vector<Placed> inner_;
  std::vector<Placed> leaves_;
  uint32_t node_count_ = 1;
  uint32_t primitive_count_ = 0;
};

}  // namespace

BvhTree join(const TreePart& root) {
  return Join().run(root);
}

}  // namespace tracer
