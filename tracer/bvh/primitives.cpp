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
  primitives.prefetch = [&mesh](uint32_t primitive) {
    const Vec3u& triangle = mesh.triangles[primitive];
    asm volatile("");  // Else GCC drops calls of what does nothing but prefetch.
    for (int corner = 0; corner < 3; ++corner) {
      __builtin_prefetch(&mesh.positions[triangle[corner]]);
    }
  };
  return primitives;
}

}  // namespace tracer
