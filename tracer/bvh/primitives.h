// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tracer/geometry/box4.h"
#include "tracer/geometry/mesh.h"

namespace tracer {

/// All that a builder knows of what it sorts: boxes[i] contains primitive i; all finite and not
/// empty; fewer than 2^31.
struct Primitives {
  std::span<const Box> boxes;
  /// Cuts a primitive by planes across `axis`, in ascending order: parts[i] becomes a box that
  /// contains what lies between planes[i - 1] and planes[i], open at the ends; empty where there
  /// is nothing. parts.size() is planes.size() + 1. Callable from many threads. No function:
  /// nothing can be cut.
  std::function<void(uint32_t primitive, int axis, std::span<const float> planes,
                     std::span<Box4> parts)>
      slice;
  /// Hints that slice() will soon be asked about a primitive. There is one where there is a slice.
  std::function<void(uint32_t primitive)> prefetch;

  Primitives() = default;
  Primitives(std::span<const Box> all_boxes) : boxes(all_boxes) {}
  template <class Allocator>
  Primitives(const std::vector<Box, Allocator>& all_boxes) : boxes(all_boxes) {}
};

/// The triangles of a mesh, which can be cut; `boxes` are primitive_boxes(mesh). Both must outlive
/// the result.
Primitives mesh_primitives(const Mesh& mesh, std::span<const Box> boxes);

}  // namespace tracer
