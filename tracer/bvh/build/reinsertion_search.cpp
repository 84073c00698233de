// SPDX-License-Identifier: MIT
#include "tracer/bvh/build/reinsertion_search.h"

#include "tracer/base/parallel.h"

namespace tracer {
namespace {

// That are looked at for one node: where all boxes overlap, nothing else bounds a search, and
// rounds would take time in the square of the nodes.
constexpr int most_places = 1 << 14;

}  // namespace

ReinsertionSearch::ReinsertionSearch(std::span<const BvhNode> nodes,
                                     std::span<const uint32_t> parents)
    : nodes_(nodes), parents_(parents), half_areas_(nodes.size()) {
  parallel_for_ranges(0, nodes.size(), 16384, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) half_areas_[i] = nodes_[i].bounds.half_area();
  });
}

// Taken out, the node saves its parent, and makes every box above that smaller. From its sibling
// upward, each subtree that hangs from the path to the root is searched.
Reinsertion ReinsertionSearch::find(uint32_t node) const {
  Reinsertion best{0, node, node};
  const Box4 box(nodes_[node].bounds);
  uint32_t pivot = parents_[node];
  uint32_t other = sibling(node);
  double saved = half_areas_[pivot];
  int places_left = most_places;
  Box4 rest;  // of the pivot without the node
  while (true) {
    search_below(other, box, saved, best, places_left);
    rest.extend(Box4(nodes_[other].bounds));
    if (pivot == 0) return best;
    if (pivot != parents_[node]) saved += half_areas_[pivot] - rest.half_area();
    other = sibling(pivot);
    pivot = parents_[pivot];
  }
}

// The node put beside some node below `root` costs their common box and the growth of all boxes
// from `root` down to there. Growth alone, and the node's own area, bound what is below.
void ReinsertionSearch::search_below(uint32_t root, const Box4& box, double saved,
                                     Reinsertion& best, int& places_left) const {
  struct Place {
    uint32_t node;
    double saved;  // less the growth above
  };
  const double least_cost = box.half_area();
  std::array<Place, max_tree_depth + 2> stack;
  size_t size = 0;
  stack[size++] = {root, saved};
  while (size > 0 && places_left-- > 0) {
    const Place place = stack[--size];
    if (place.saved - least_cost <= best.gain) continue;
    const BvhNode& node = nodes_[place.node];
    Box4 both(node.bounds);
    both.extend(box);
    const double area = both.half_area();
    if (place.saved - area > best.gain) best = {place.saved - area, best.node, place.node};
    if (node.is_leaf()) continue;
    const double saved_below = place.saved - (area - half_areas_[place.node]);
    if (saved_below - least_cost <= best.gain) continue;
    stack[size++] = {node.first, saved_below};
    stack[size++] = {node.first + 1, saved_below};
  }
}

}  // namespace tracer
