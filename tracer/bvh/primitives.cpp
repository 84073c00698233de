// SPDX-License-Identifier: MIT
#include "tracer/bvh/primitives.h"

#include "tracer/geometry/slice_triangle.h"

namespace tracer {

Primitives mesh_primitives(const Mesh& mesh, std::span<const Box> boxes) {
  Primitives primitives(boxes);
  primitives.slice = [&mesh](uint32_t primitive, int axis, std::span<const float> planes,
                             std::span<Box4> parts) {
    const Vec3u& triangle = mesh.triangles[primitive];
    slice_triangle(
        {mesh.positions[triangle.x], mesh.positions[triangle.y], mesh.positions[triangle.z]}, axis,
        planes, parts);
  };
  return primitives;
}

}  // namespace tracer
