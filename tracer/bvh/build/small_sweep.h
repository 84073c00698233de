// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tracer/bvh/build/reference.h"
#include "tracer/bvh/build/split_cost.h"
#include "tracer/bvh/tree.h"

namespace tracer {

/// The surface area heuristic over all planes between the centres of a few primitives, which stay
/// in the cache: what is below the lowest bins. Sorted once; every split keeps the orders sorted.
class SmallSweep {
 public:
  static constexpr uint32_t capacity = 32;

  /// What is the same for all small sweeps of a build.
  struct Costs {
    float scale;  // unit_scale of the scene
    uint32_t leaf_size;
    std::array<float, capacity + 1> blocks;  // by count of primitives

    Costs(float area_scale, const BuildSettings& settings);
  };

  /// One to `capacity` references; `half_centers` bound their half centres.
  SmallSweep(std::span<const Reference> references, const Box4& half_centers, const Costs& costs);

  /// Turns nodes[node] into the root over all references, appends what is below it, and writes the
  /// order of the primitives from `primitives` on, which is BvhTree::primitives[first].
  void subdivide(std::vector<BvhNode>& nodes, uint32_t node, int levels_left, uint32_t first,
                 uint32_t* primitives);

 private:
  using Order = std::array<uint8_t, capacity>;
  struct Node {
    uint32_t begin;
    uint32_t end;
    uint32_t index;
    int levels_left;
  };
  struct Split {
    int axis;
    uint32_t middle;
  };

  void sort(const Box4& half_centers);
  void subdivide(std::vector<BvhNode>& nodes, const Node& node, uint32_t first);
  Box bounds(uint32_t begin, uint32_t end) const;
  Split best_split(uint32_t begin, uint32_t end, int levels_left) const;
  void partition(uint32_t begin, uint32_t end, Split split);

  const std::span<const Reference> references_;
  const Costs& costs_;
  std::array<Box4, capacity> boxes_;  // scaled
  std::array<Order, 3> orders_;       // of the references, by centre along each axis
};

}  // namespace tracer
