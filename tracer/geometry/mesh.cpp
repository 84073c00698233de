// SPDX-License-Identifier: MIT
#include "tracer/geometry/mesh.h"

#include "tracer/base/parallel.h"
#include "tracer/geometry/box4.h"

namespace tracer {

Box Mesh::triangle_bounds(uint32_t triangle) const {
  const Vec3u& corners = triangles[triangle];
  Box4 box(lanes_of(positions[corners.x]));
  box.extend(lanes_of(positions[corners.y]));
  box.extend(lanes_of(positions[corners.z]));
  return box.box();
}

LargeVector<Box> primitive_boxes(const Mesh& mesh) {
  LargeVector<Box> boxes(mesh.triangles.size());
  parallel_for_ranges(0, boxes.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) boxes[i] = mesh.triangle_bounds(static_cast<uint32_t>(i));
  });
  return boxes;
}

}  // namespace tracer
