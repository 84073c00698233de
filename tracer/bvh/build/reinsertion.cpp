// SPDX-License-Identifier: MIT
#include "tracer/bvh/build/reinsertion.h"

#include <algorithm>
#include <atomic>
#include <tuple>
#include <utility>

#include "tracer/base/parallel.h"
#include "tracer/bvh/build/reinsertion_search.h"
#include "tracer/bvh/metrics.h"

namespace tracer {
namespace {

class Round {
 public:
  Round(const BvhTree& tree, const BuildSettings& settings, Progress& progress)
      : tree_(tree),
        nodes_(tree.nodes),
        parents_(nodes_.size()),
        heights_(nodes_.size()),
        touched_(nodes_.size()),
        max_depth_(std::clamp(settings.max_depth, 0, max_tree_depth)),
        progress_(progress) {
    for (uint32_t i = 0; i < nodes_.size(); ++i) adopt_children(i);
    for (size_t i = nodes_.size(); i-- > 0;) {
      if (!nodes_[i].is_leaf()) heights_[i] = height_over(nodes_[i].first, nodes_[i].first + 1);
    }
    if (!heights_.empty()) max_depth_ = std::max(max_depth_, heights_[0]);
  }

  BvhTree run() {
    std::vector<Reinsertion> reinsertions = find_all();
    // The largest gain goes first; what it touches stays as it is for this round.
    std::ranges::sort(reinsertions, [](const Reinsertion& a, const Reinsertion& b) {
      return std::tie(b.gain, a.node) < std::tie(a.gain, b.node);
    });
    for (size_t i = 0; i < reinsertions.size(); ++i) {
      if (i % 1024 == 0) progress_.throw_if_stopped();
      apply(reinsertions[i]);
    }
    return in_order();
  }

 private:
  std::vector<Reinsertion> find_all() {
    const ReinsertionSearch search(nodes_, parents_);
    std::vector<Reinsertion> reinsertions(nodes_.size());
    std::atomic<size_t> done{0};
    parallel_for_ranges(1, nodes_.size(), 256, [&](size_t begin, size_t end) {
      progress_.throw_if_stopped();
      for (size_t i = begin; i < end; ++i) {
        // The root's children have nowhere to go.
        if (parents_[i] != 0) reinsertions[i] = search.find(static_cast<uint32_t>(i));
      }
      const size_t count = done.fetch_add(end - begin, std::memory_order_relaxed) + end - begin;
      progress_.set_fraction(static_cast<double>(count) / static_cast<double>(nodes_.size()));
    });
    std::erase_if(reinsertions, [](const Reinsertion& found) { return !(found.gain > 0); });
    return reinsertions;
  }

  void adopt_children(uint32_t node) {
    if (nodes_[node].is_leaf()) return;
    parents_[nodes_[node].first] = parents_[nodes_[node].first + 1] = node;
  }

  int height_over(uint32_t a, uint32_t b) const { return 1 + std::max(heights_[a], heights_[b]); }

  // The node's pair of slots is reused: its sibling moves up into their parent's slot, the target
  // moves down beside the node, and the target's slot becomes the parent of both.
  void apply(const Reinsertion& move) {
    const uint32_t parent = parents_[move.node];
    const uint32_t pair = nodes_[parent].first;
    const uint32_t sibling = pair == move.node ? pair + 1 : pair;
    const uint32_t changed[] = {move.node,        sibling,     parent,
                                parents_[parent], move.target, parents_[move.target]};
    for (const uint32_t node : changed) {
      if (touched_[node] != 0) return;
    }
    if (!has_room_beside(move.target, move.node)) return;
    for (const uint32_t node : changed) touched_[node] = 1;
    put(parent, sibling);
    put(sibling, move.target);
    parents_[move.node] = parents_[sibling] = move.target;
    nodes_[move.target].first = pair;
    nodes_[move.target].count = 0;
    raise(move.target, height_over(move.node, sibling));
  }

  // Whether the target is not below the node by now, and neither would come too deep.
  bool has_room_beside(uint32_t target, uint32_t node) const {
    int depth = 0;
    for (uint32_t above = target; above != 0; above = parents_[above]) {
      if (above == node) return false;
      ++depth;
    }
    return depth + height_over(node, target) <= max_depth_;
  }

  // Makes `slot` the node that was in `from`.
  void put(uint32_t slot, uint32_t from) {
    nodes_[slot] = nodes_[from];
    heights_[slot] = heights_[from];
    adopt_children(slot);
  }

  // Heights never fall within a round, which errs on the side of the depth allowed.
  void raise(uint32_t node, int height) {
    heights_[node] = height;
    while (node != 0 && heights_[parents_[node]] <= heights_[node]) {
      heights_[parents_[node]] = heights_[node] + 1;
      node = parents_[node];
    }
  }

  BvhTree in_order() const {
    BvhTree ordered;
    ordered.nodes.reserve(nodes_.size());
    ordered.primitives.reserve(tree_.primitives.size());
    ordered.nodes.resize(1);
    place(ordered, 0, 0);
    refit(ordered);
    return ordered;
  }

  void place(BvhTree& ordered, uint32_t slot, uint32_t from) const {
    BvhNode node = nodes_[from];
    if (node.is_leaf()) {
      const auto first = tree_.primitives.begin() + node.first;
      node.first = static_cast<uint32_t>(ordered.primitives.size());
      ordered.primitives.insert(ordered.primitives.end(), first, first + node.count);
      ordered.nodes[slot] = node;
      return;
    }
    const uint32_t children =
        std::exchange(node.first, static_cast<uint32_t>(ordered.nodes.size()));
    ordered.nodes[slot] = node;
    ordered.nodes.resize(ordered.nodes.size() + 2);
    place(ordered, node.first, children);
    place(ordered, node.first + 1, children + 1);
  }

  const BvhTree& tree_;
  LargeVector<BvhNode> nodes_;
  std::vector<uint32_t> parents_;
  std::vector<int> heights_;      // of what is below each node, at least
  std::vector<uint8_t> touched_;  // in this round
  int max_depth_;
  Progress& progress_;
};

}  // namespace

BvhTree reinsert(const BvhTree& tree, const BuildSettings& settings, Progress& progress) {
  progress.throw_if_stopped();
  if (tree.nodes.size() < 5) return tree;
  BvhTree better = Round(tree, settings, progress).run();
  progress.throw_if_stopped();
  return measure(better).sah_cost < measure(tree).sah_cost ? better : tree;
}

}  // namespace tracer
