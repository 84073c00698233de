// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tracer/bvh/build_settings.h"
#include "tracer/bvh/tree.h"
#include "tracer/geometry/box4.h"

namespace tracer {

/// A node to be taken out, and the node beside which it is put.
struct Reinsertion {
  double gain = 0;  // of half area; none where it is not positive
  uint32_t node = 0;
  uint32_t target = 0;
};

/// Finds the best place of a node in a tree that does not change meanwhile.
class ReinsertionSearch {
 public:
  /// Both must outlive this. parents[0] means nothing.
  ReinsertionSearch(std::span<const BvhNode> nodes, std::span<const uint32_t> parents);

  double half_area(uint32_t node) const { return half_areas_[node]; }
  /// `node` is neither the root nor one of its children. Callable from many threads.
  Reinsertion find(uint32_t node) const;

 private:
  void search_below(uint32_t root, const Box4& box, double saved, Reinsertion& best,
                    int& places_left) const;
  uint32_t sibling(uint32_t node) const {
    const uint32_t first = nodes_[parents_[node]].first;
    return first == node ? first + 1 : first;
  }

  std::span<const BvhNode> nodes_;
  std::span<const uint32_t> parents_;
  std::vector<double> half_areas_;
};

}  // namespace tracer
