// SPDX-License-Identifier: MIT
#include "tracer/bvh/trace/accel.h"

#include "tracer/bvh/trace/recursive.h"
#include "tracer/geometry/triangle.h"

namespace tracer {
namespace {

// Triangles that brute force meets between two looks at the stop flag: some 20 microseconds.
constexpr uint32_t triangles_a_look = 1024;

// A miss once `stop` is requested: a tree's leaf may hold millions of triangles.
auto triangle_intersector(const Mesh& mesh, const StopFlag& stop) {
  return [&mesh, &stop](uint32_t primitive, const Ray& ray) {
    if (stop.requested()) return Hit{};
    const Vec3u& index = mesh.triangles[primitive];
    const auto hit = intersect_triangle(ray, mesh.positions[index.x], mesh.positions[index.y],
                                        mesh.positions[index.z]);
    return hit ? Hit{hit->t, hit->u, hit->v, primitive} : Hit{};
  };
}

}  // namespace

Hit RayCaster::closest_hit(const Ray& ray) {
  ++ray_count_;
  const auto intersect = triangle_intersector(*accel_.mesh, stop_);
  if (accel_.tree) return closest_hit_recursive(*accel_.tree, ray, intersect);
  Hit best;
  for (uint32_t i = 0; i < accel_.mesh->triangle_count(); ++i) {
    if (i % triangles_a_look == 0 && stop_.requested()) return {};
    const Hit hit = intersect(i, ray);
    if (hit.is_hit() && hit.is_closer_than(best)) best = hit;
  }
  return best;
}

bool RayCaster::occluded(const Ray& ray) {
  ++ray_count_;
  const auto intersect = triangle_intersector(*accel_.mesh, stop_);
  if (accel_.tree) return occluded_recursive(*accel_.tree, ray, intersect);
  for (uint32_t i = 0; i < accel_.mesh->triangle_count(); ++i) {
    if (i % triangles_a_look == 0 && stop_.requested()) return false;
    if (intersect(i, ray).is_hit()) return true;
  }
  return false;
}

}  // namespace tracer
