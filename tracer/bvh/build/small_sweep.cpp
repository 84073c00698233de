// SPDX-License-Identifier: MIT
#include "tracer/bvh/build/small_sweep.h"

namespace tracer {

SmallSweep::Costs::Costs(float area_scale, const BuildSettings& settings)
    : scale(area_scale), leaf_size(static_cast<uint32_t>(std::max(settings.leaf_size, 1))) {
  const BlockCount block_count(settings);
  for (uint32_t count = 0; count <= capacity; ++count) blocks[count] = block_count(count);
}

SmallSweep::SmallSweep(std::span<const Reference> references, const Box4& half_centers,
                       const Costs& costs)
    : references_(references), costs_(costs) {
  for (size_t i = 0; i < references.size(); ++i) {
    boxes_[i] = scaled(references[i].box(), costs.scale);
  }
  sort(half_centers);
}

// By counting smaller keys. A key is a centre in 2^25 steps of their bounds, then the position, so
// that no two are the same.
void SmallSweep::sort(const Box4& half_centers) {
  const auto count = static_cast<uint32_t>(references_.size());
  const Float4 steps = 0x1p25f / (half_centers.max - half_centers.min);
  const Float4 scale = steps < Box4::infinity ? steps : Float4{};
  Int4 keys[3][capacity / 4];
  for (uint32_t i = 0; i < (count + 3) / 4 * 4; ++i) {
    Int4 key = Int4{} + std::numeric_limits<int32_t>::max();
    if (i < count) {
      const Float4 offset = half_center_of(references_[i].box()) - half_centers.min;
      // Shifted, where lane w, which means nothing, may overflow.
      key = (__builtin_convertvector(offset * scale, Int4) << 5) + static_cast<int32_t>(i);
    }
    for (int axis = 0; axis < 3; ++axis) keys[axis][i / 4][i % 4] = key[axis];
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (uint32_t i = 0; i < count; ++i) {
      const int32_t key = keys[axis][i / 4][i % 4];
      Int4 smaller{};
      for (uint32_t four = 0; four < (count + 3) / 4; ++four) smaller -= keys[axis][four] < key;
      const int32_t rank = smaller[0] + smaller[1] + smaller[2] + smaller[3];
      orders_[axis][static_cast<uint32_t>(rank)] = static_cast<uint8_t>(i);
    }
  }
}

void SmallSweep::subdivide(std::vector<BvhNode>& nodes, uint32_t node, int levels_left,
                           uint32_t first, uint32_t* primitives) {
  const auto count = static_cast<uint32_t>(references_.size());
  subdivide(nodes, {0, count, node, levels_left}, first);
  for (uint32_t i = 0; i < count; ++i) primitives[i] = references_[orders_[0][i]].primitive;
}

void SmallSweep::subdivide(std::vector<BvhNode>& nodes, const Node& node, uint32_t first) {
  const uint32_t count = node.end - node.begin;
  if (count <= costs_.leaf_size || node.levels_left == 0) {
    nodes[node.index] = {bounds(node.begin, node.end), first + node.begin, count};
    return;
  }
  const Split split = best_split(node.begin, node.end, node.levels_left);
  partition(node.begin, node.end, split);
  const auto children = static_cast<uint32_t>(nodes.size());
  nodes[node.index] = {bounds(node.begin, node.end), children, 0};
  nodes.resize(nodes.size() + 2);
  subdivide(nodes, {node.begin, split.middle, children, node.levels_left - 1}, first);
  subdivide(nodes, {split.middle, node.end, children + 1, node.levels_left - 1}, first);
}

Box SmallSweep::bounds(uint32_t begin, uint32_t end) const {
  Box4 all;
  for (uint32_t i = begin; i < end; ++i) all.extend(references_[orders_[0][i]].box());
  return all.box();
}

SmallSweep::Split SmallSweep::best_split(uint32_t begin, uint32_t end, int levels_left) const {
  const uint32_t count = end - begin;
  const uint32_t limit = side_limit(count, static_cast<int>(costs_.leaf_size), levels_left);
  Box4 x, y, z;
  const auto extend = [&](uint32_t i) {
    x.extend(boxes_[orders_[0][i]]);
    y.extend(boxes_[orders_[1][i]]);
    z.extend(boxes_[orders_[2][i]]);
  };
  Float4 right_areas[capacity];
  for (uint32_t i = end - 1; i > begin; --i) {
    extend(i);
    right_areas[i] = half_areas(x, y, z);
  }
  x = y = z = Box4();
  BestSplits best;
  for (uint32_t middle = begin + 1; middle < end; ++middle) {
    extend(middle - 1);
    const uint32_t larger_side = std::max(middle - begin, end - middle);
    if (larger_side > limit) continue;
    best.offer(half_areas(x, y, z), Float4{} + costs_.blocks[middle - begin], right_areas[middle],
               Float4{} + costs_.blocks[end - middle], Int4{} + static_cast<int32_t>(larger_side),
               ~Int4{}, static_cast<int>(middle));
  }
  return {best.axis(), static_cast<uint32_t>(best.place())};
}

void SmallSweep::partition(uint32_t begin, uint32_t end, Split split) {
  std::array<uint8_t, capacity> goes_left;
  for (uint32_t i = begin; i < end; ++i) goes_left[orders_[split.axis][i]] = i < split.middle;
  Order right_side;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == split.axis) continue;
    Order& order = orders_[axis];
    uint32_t left_end = begin;
    uint32_t right_count = 0;
    for (uint32_t i = begin; i < end; ++i) {
      const uint8_t reference = order[i];
      order[left_end] = reference;
      right_side[right_count] = reference;
      left_end += goes_left[reference];
      right_count += !goes_left[reference];
    }
    std::copy_n(right_side.begin(), right_count, order.begin() + left_end);
  }
}

}  // namespace tracer
