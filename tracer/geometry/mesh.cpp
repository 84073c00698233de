// SPDX-License-Identifier: MIT
#include "tracer/geometry/mesh.h"

#include "tracer/base/parallel.h"

namespace tracer {

Box Mesh::triangle_bounds(uint32_t triangle) const {
  Box box;
  for (int corner = 0; corner < 3; ++corner) box.extend(positions[triangles[triangle][corner]]);
  return box;
}

std::vector<Box> primitive_boxes(const Mesh& mesh) {
  std::vector<Box> boxes(mesh.triangles.size());
  parallel_for_ranges(0, boxes.size(), 16384, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) boxes[i] = mesh.triangle_bounds(static_cast<uint32_t>(i));
  });
  return boxes;
}

}  // namespace tracer
