// SPDX-License-Identifier: MIT
#include "tracer/bvh/layout/leaf_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tracer/bvh/layout/lanes.h"

namespace tracer {
void LeafWriter::write(PrimitiveRange range, const Box& bounds, size_t first_block) const {
  Box4 box(bounds);
  size_t block = first_block;
  for (uint32_t begin = range.begin; begin < range.end; ++block) {
    const uint32_t end = begin + std::min(width_, range.end - begin);
    write_block({begin, end}, tree_.blocks.row(block * WideTree::rows_a_block), box);
    tree_.block_infos[block] = {0, static_cast<uint16_t>(end - begin), end == range.end};
    begin = end;
  }
  // Of all vertices and the leaf's box: spatial splits leave vertices outside it.
  const Vec3d size = box.box().extent();
  const float extent = std::nextafter(static_cast<float>(std::max({size.x, size.y, size.z})),
                                      std::numeric_limits<float>::infinity());
  for (size_t i = first_block; i < block; ++i) tree_.block_infos[i].extent = extent;
}

// Unused lanes repeat the last triangle.
void LeafWriter::write_block(PrimitiveRange range, float* rows, Box4& box) const {
  uint32_t lane = 0;
  for (uint32_t i = range.begin; i < range.end; i += 4, lane += 4) {
    write_four(i, range.end - 1, rows + lane, box);
  }
  for (size_t row = 0; row < WideTree::rows_a_block && lane < width_; ++row) {
    float* const rest = rows + row * width_ + lane;
    const Float4 last = splat_last(load(rest - 4));
    for (uint32_t i = 0; i < width_ - lane; i += 4) store(rest + i, last);
  }
}

void LeafWriter::write_four(uint32_t first, uint32_t last, float* rows, Box4& box) const {
  std::array<uint32_t, 4> primitives;
  for (uint32_t i = 0; i < 4; ++i) {
    primitives[i] = primitives_[std::min(first + i, last)];
    fetch_behind(first + i);
  }
  for (int corner = 0; corner < 3; ++corner) {
    std::array<Float4, 4> positions;
    for (size_t i = 0; i < 4; ++i) {
      positions[i] = lanes_of(mesh_.positions[mesh_.triangles[primitives[i]][corner]]);
      box.extend(positions[i]);
    }
    transpose(positions);
    for (size_t axis = 0; axis < 3; ++axis, rows += width_) store(rows, positions[axis]);
  }
  std::memcpy(rows, primitives.data(), sizeof primitives);
}

void LeafWriter::fetch_behind(uint32_t position) const {
  constexpr uint32_t distance = 24;
  if (position + 2 * distance >= primitives_.size()) return;
  __builtin_prefetch(&mesh_.triangles[primitives_[position + 2 * distance]]);
  const Vec3u& triangle = mesh_.triangles[primitives_[position + distance]];
  for (int corner = 0; corner < 3; ++corner) {
    __builtin_prefetch(&mesh_.positions[triangle[corner]]);
  }
}

}  // namespace tracer
