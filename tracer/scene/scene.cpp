// SPDX-License-Identifier: MIT
#include "tracer/scene/scene.h"

#include "tracer/base/directions.h"
#include "tracer/geometry/ray.h"
#include "tracer/scene/surface_maps.h"

namespace tracer {
namespace {

/// Colours of corners multiply the base colour.
Vec3f base_color(const Mesh& mesh, const Material& material, const Hit& hit) {
  const Vec3f& color = material.scattering.base_color;
  if (mesh.colors.empty()) return color;
  const Vec3u& corner = mesh.triangles[hit.primitive];
  const Triangle colors{Vec3d(mesh.colors[corner.x]), Vec3d(mesh.colors[corner.y]),
                        Vec3d(mesh.colors[corner.z])};
  return Vec3f(glm::clamp(Vec3d(color) * colors.at(hit.u, hit.v), 0.0, 1.0));
}

/// The interpolated normal on the side of `geometric_normal`, or that where there is none.
Vec3d shading_normal(const Scene& scene, const Hit& hit, const Vec3d& geometric_normal) {
  if (scene.shading == Shading::flat) return geometric_normal;
  const LargeVector<Vec3f>& normals = *scene.shading_normals;
  const Vec3u& corner = (*scene.shading_normal_indices)[hit.primitive];
  const Triangle corners{Vec3d(normals[corner.x]), Vec3d(normals[corner.y]),
                         Vec3d(normals[corner.z])};
  const Vec3d normal = unit_or(corners.at(hit.u, hit.v), geometric_normal);
  return glm::dot(normal, geometric_normal) < 0 ? -normal : normal;
}

/// A point of the triangle near `position`, at least `distance` from its edges where it is that
/// large. Rays that start there are not pushed through the neighbour across an edge.
Vec3d keep_off_edges(const Triangle& triangle, const Hit& hit, const Vec3d& position,
                     double distance) {
  const double twice_area = 2 * triangle.area();
  Vec3d weights(1 - hit.u - hit.v, hit.u, hit.v);
  const Vec3d opposite_sides(glm::length(triangle.v2 - triangle.v1),
                             glm::length(triangle.v0 - triangle.v2),
                             glm::length(triangle.v1 - triangle.v0));
  bool is_clear = true;
  for (int i = 0; i < 3; ++i) {
    // The height over a side is twice_area / side.
    const double least = std::min(distance * opposite_sides[i] / twice_area, 0.25);
    if (weights[i] >= least) continue;
    weights[i] = least;
    is_clear = false;
  }
  if (is_clear) return position;
  weights /= weights.x + weights.y + weights.z;
  return triangle.at(weights.y, weights.z);
}

}  // namespace

Triangle triangle_at(const Mesh& mesh, uint32_t triangle) {
  const Vec3u& corner = mesh.triangles[triangle];
  return {Vec3d(mesh.positions[corner.x]), Vec3d(mesh.positions[corner.y]),
          Vec3d(mesh.positions[corner.z])};
}

// With m the largest |coordinates| of the corners, n the normal and u = 2^-24, distances from the
// plane are at most
//   u n.m     for rounding the origin to float, which moves it by u |p_i| <= u m_i an axis;
//   4 u n.m   for a neighbour that was coplanar (a quad's other half) before its corners and ours
//             were rounded to float: u n.m for each of four corners;
//   2^-49 |m| for computing the position and the normal in double, some ten roundings, unless the
//             triangle's sides are within 2^-20 of parallel.
// 6 u n.m + 2^-46 |m| exceeds their sum. Where the plane passes exactly through an axis (n.m = 0)
// float coordinates hold the second term exactly enough: they are finest near 0.
double clearance_of(const Triangle& triangle, const Vec3d& normal) {
  const Vec3d largest =
      glm::max(glm::abs(triangle.v0), glm::max(glm::abs(triangle.v1), glm::abs(triangle.v2)));
  return 6 * 0x1p-24 * glm::dot(glm::abs(normal), largest) +
         0x1p-46 * (largest.x + largest.y + largest.z);
}

Surface surface_at(const Scene& scene, const Hit& hit, const Vec3d& ray_direction,
                   double footprint) {
  const Triangle triangle = triangle_at(*scene.mesh, hit.primitive);
  const Material& material = (*scene.materials)[scene.mesh->material_of(hit.primitive)];
  const Vec3d back = unit_or(-ray_direction, {0, 0, 1});
  const Vec3d normal = unit_or(triangle.area_normal(), back);
  Surface surface;
  surface.geometric_normal = glm::dot(normal, back) < 0 ? -normal : normal;
  surface.shading_normal = shading_normal(scene, hit, surface.geometric_normal);
  surface.scattering = material.scattering;
  surface.scattering.base_color = base_color(*scene.mesh, material, hit);
  surface.emission = Vec3d(material.emission);
  if (material.has_maps) apply_maps(scene, material, hit, triangle, footprint, surface);
  surface.clearance = clearance_of(triangle, surface.geometric_normal);
  // What offset_origin may move the point sideways, for neighbours at angles of 15 degrees or more.
  const Vec3d position = triangle.at(hit.u, hit.v);
  const double rounding = 0x1p-24 * glm::dot(glm::abs(position), Vec3d(1));
  surface.position = keep_off_edges(triangle, hit, position, 4 * (surface.clearance + rounding));
  surface.triangle = hit.primitive;
  return surface;
}

Vec3f offset_origin(const Surface& surface) {
  return Vec3f(surface.position + surface.clearance * surface.geometric_normal);
}

}  // namespace tracer
