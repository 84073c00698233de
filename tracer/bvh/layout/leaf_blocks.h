// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "tracer/bvh/build/subdivide.h"
#include "tracer/bvh/layout/wide_tree.h"
#include "tracer/geometry/box4.h"

namespace tracer {

/// Puts triangles into the blocks of a wide tree, leaf by leaf; from many threads.
class LeafWriter {
 public:
  /// `primitives` are the triangles in the order of the leaves; `width` is that of `tree`.
  LeafWriter(std::span<const uint32_t> primitives, const Mesh& mesh, uint32_t width, WideTree& tree)
      : primitives_(primitives), mesh_(mesh), width_(width), tree_(tree) {}

  /// A leaf of `range` in the box `bounds`, into blocks from `first_block` on.
  void write(PrimitiveRange range, const Box& bounds, size_t first_block) const;

 private:
  void write_block(PrimitiveRange range, float* rows, Box4& box) const;
  /// Lanes from positions `first` on; those behind `last` repeat it.
  void write_four(uint32_t first, uint32_t last, float* rows, Box4& box) const;
  /// Into the cache: what leaves hold is not in the order of the mesh.
  void fetch_behind(uint32_t position) const;

  const std::span<const uint32_t> primitives_;
  const Mesh& mesh_;
  const uint32_t width_;
  WideTree& tree_;
};

}  // namespace tracer
