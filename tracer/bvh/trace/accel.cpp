// SPDX-License-Identifier: MIT
#include "tracer/bvh/trace/accel.h"

#include <algorithm>
#include <utility>

#include "tracer/bvh/trace/recursive.h"
#include "tracer/bvh/trace/wide_kernels.h"
#include "tracer/bvh/trace/wide_scalar.h"
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

void lay_out_wide(Accel& accel, Progress& progress) {
  const int width = wide_kernel_width();
  if (width > 0 && accel.tree && !accel.tree->nodes.empty()) {
    accel.wide = std::make_shared<const WideTree>(
        build_wide_tree(*accel.tree, *accel.mesh, width, progress));
    accel.tree.reset();
  }
}

void keep_binary(Accel&, Progress&) {}

constexpr Layout layout_table[] = {
    {"wide", "Wide nodes, SIMD", "All children of a node and all triangles of a leaf at once",
     lay_out_wide},
    {"binary", "Binary, recursive", "The readable reference: near child first, then the far one",
     keep_binary},
};

}  // namespace

std::span<const Layout> layouts() {
  return layout_table;
}

const Layout* find_layout(std::string_view name) {
  const auto found = std::ranges::find(layout_table, name, &Layout::name);
  return found == std::end(layout_table) ? nullptr : found;
}

Accel make_accel(std::shared_ptr<const Mesh> mesh, std::shared_ptr<const BvhTree> tree,
                 const Layout& layout, Progress& progress) {
  Accel accel{std::move(mesh), std::move(tree)};
  layout.lay_out(accel, progress);
  return accel;
}

Accel make_accel(std::shared_ptr<const Mesh> mesh, std::optional<BvhTree> tree,
                 const Layout& layout, Progress& progress) {
  auto shared = tree ? std::make_shared<const BvhTree>(*std::move(tree)) : nullptr;
  return make_accel(std::move(mesh), std::move(shared), layout, progress);
}

Hit RayCaster::closest_hit(const Ray& ray) {
  ++ray_count_;
  if (stop_.requested()) return {};
  if (accel_.wide) {
    Hit hit;
    if (closest_hit_wide(*accel_.wide, ray, stop_, hit)) return hit;
    return closest_hit_scalar(*accel_.wide, ray, triangle_intersector(*accel_.mesh, stop_));
  }
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
  if (stop_.requested()) return false;
  if (accel_.wide) {
    Hit hit;
    if (occluded_wide(*accel_.wide, ray, stop_, hit)) return hit.is_hit();
    return occluded_scalar(*accel_.wide, ray, triangle_intersector(*accel_.mesh, stop_));
  }
  const auto intersect = triangle_intersector(*accel_.mesh, stop_);
  if (accel_.tree) return occluded_recursive(*accel_.tree, ray, intersect);
  for (uint32_t i = 0; i < accel_.mesh->triangle_count(); ++i) {
    if (i % triangles_a_look == 0 && stop_.requested()) return false;
    if (intersect(i, ray).is_hit()) return true;
  }
  return false;
}

}  // namespace tracer
