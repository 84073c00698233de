// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "tracer/base/progress.h"
#include "tracer/bvh/tree.h"
#include "tracer/geometry/mesh.h"

namespace tracer {

/// Where a lane of a wide node leads: a node, or the first block of a leaf.
struct WideChild {
  static constexpr uint32_t leaf_bit = 0x80000000u;

  uint32_t bits;  // no initialiser: a traversal stack of these must cost nothing

  static WideChild node(uint32_t index) { return {index}; }
  static WideChild leaf(uint32_t first_block) { return {first_block | leaf_bit}; }
  bool is_leaf() const { return (bits & leaf_bit) != 0; }
  uint32_t index() const { return bits & ~leaf_bit; }
};

/// Rows of `width` floats, one 64-byte aligned allocation, so that a row is one SIMD load.
class FloatRows {
 public:
  FloatRows() = default;
  FloatRows(size_t row_count, int width);
  float* row(size_t index) { return data_.get() + index * static_cast<size_t>(width_); }
  const float* row(size_t index) const { return data_.get() + index * static_cast<size_t>(width_); }
  size_t bytes() const { return row_count_ * static_cast<size_t>(width_) * sizeof(float); }

 private:
  struct Free {
    void operator()(float* data) const { std::free(data); }
  };
  std::unique_ptr<float[], Free> data_;
  size_t row_count_ = 0;
  int width_ = 0;
};

/// A tree with up to `width` children a node, collapsed from a binary tree, and its triangles in
/// blocks of `width`: what one SIMD instruction takes.
struct WideTree {
  static constexpr size_t rows_a_node = 7;  // x min, x max, y min, y max, z min, z max, child bits
  static constexpr size_t rows_a_block = 10;  // x, y, z of v0, of v1, of v2, primitive index bits

  struct BlockInfo {
    float extent = 0;      // longest side of the leaf's box and its whole triangles, rounded up
    uint16_t count = 0;    // triangles in this block; unused lanes repeat the last one
    uint16_t is_last = 0;  // of its leaf
  };

  int width = 0;
  FloatRows nodes;  // nodes[0] is the root; unused lanes have empty boxes
  FloatRows blocks;
  std::vector<BlockInfo> block_infos;
  float max_coordinate = 0;           // of all boxes, absolute
  float typical_extent = 0;           // median of block_infos' extents, of 1024 at most
  float expected_steps = 0;           // nodes and blocks that a random line through the root meets
  bool is_larger_than_cache = false;  // a core's own
  bool is_larger_than_shared_cache = false;  // of all cores

  size_t bytes() const {
    return nodes.bytes() + blocks.bytes() + block_infos.size() * sizeof(BlockInfo);
  }
};

/// Collapses `tree` to nodes of `width` children so that the surface area cost is least
/// [Wald 2008]. Subtrees of at most `width` triangles become one block. `tree` is not empty;
/// `width` at most 16. Throws Cancelled.
WideTree build_wide_tree(const BvhTree& tree, const Mesh& mesh, int width, Progress& progress);

}  // namespace tracer
