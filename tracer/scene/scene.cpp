// SPDX-License-Identifier: MIT
#include "tracer/scene/scene.h"

#include "tracer/base/directions.h"
#include "tracer/geometry/ray.h"
#include "tracer/scene/flat_surface-inl.h"
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

}  // namespace

MaterialSummary summarize(const std::vector<Material>& materials) {
  MaterialSummary summary{BsdfFeatures::diffuse, false, false};
  for (const Material& material : materials) {
    const auto has_map = [&](MapSlot slot) { return !material.map(slot).empty(); };
    BsdfFeatures features = features_of(material.scattering);
    if (has_map(MapSlot::specular) || has_map(MapSlot::metallic)) {
      features = features | BsdfFeatures::reflection;
    }
    summary.features = summary.features | features;
    summary.has_alpha = summary.has_alpha || !is_opaque(material);
    summary.has_shining_textures = summary.has_shining_textures || has_map(MapSlot::emission);
  }
  return summary;
}

Triangle triangle_at(const Mesh& mesh, uint32_t triangle) {
  const Vec3u& corner = mesh.triangles[triangle];
  return {Vec3d(mesh.positions[corner.x]), Vec3d(mesh.positions[corner.y]),
          Vec3d(mesh.positions[corner.z])};
}

double clearance_of(const Triangle& triangle, const Vec3d& normal) {
  using namespace HWY_NAMESPACE;
  return HWY_NAMESPACE::clearance_of(corners_of(triangle), components(normal));
}

Surface surface_at(const Scene& scene, const Hit& hit, const Vec3d& ray_direction,
                   double footprint) {
  const Triangle triangle = triangle_at(*scene.mesh, hit.primitive);
  const Material& material = (*scene.materials)[scene.mesh->material_of(hit.primitive)];
  using namespace HWY_NAMESPACE;
  const auto [position, normal, clearance] =
      flat_surface(corners_of(triangle), hit.u, hit.v, components(ray_direction));
  Surface surface;
  surface.position = joined(position);
  surface.geometric_normal = joined(normal);
  surface.clearance = clearance;
  surface.shading_normal = shading_normal(scene, hit, surface.geometric_normal);
  surface.scattering = material.scattering;
  surface.scattering.base_color = base_color(*scene.mesh, material, hit);
  surface.emission = Vec3d(material.emission);
  if (material.has_maps) apply_maps(scene, material, hit, triangle, footprint, surface);
  surface.triangle = hit.primitive;
  surface.is_front = glm::dot(triangle.area_normal(), surface.geometric_normal) >= 0;
  return surface;
}

Vec3f offset_origin(const Surface& surface) {
  return Vec3f(surface.position + surface.clearance * surface.geometric_normal);
}

Vec3f offset_origin_behind(const Surface& surface) {
  return Vec3f(surface.position - surface.clearance * surface.geometric_normal);
}

}  // namespace tracer
