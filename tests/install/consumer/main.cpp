// SPDX-License-Identifier: MIT
// Another project's first program with the installed library.
#include <cstdio>

#include <tracer/bvh/build.h>
#include <tracer/bvh/trace/accel.h>

int main() {
  auto mesh = std::make_shared<tracer::Mesh>();
  mesh->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh->triangles = {{0, 1, 2}};
  tracer::Progress progress;
  const tracer::Accel accel =
      make_accel(mesh, tracer::builders().front().build(primitive_boxes(*mesh), {}, progress),
                 tracer::layouts().front(), progress);

  const tracer::StopFlag stop;
  tracer::RayCaster rays(accel, stop);
  const tracer::Hit hit = rays.closest_hit({.origin{0.25f, 0.25f, 1}, .direction{0, 0, -1}});
  std::printf("%u triangle, hit at %g\n", mesh->triangle_count(), hit.t);
}
