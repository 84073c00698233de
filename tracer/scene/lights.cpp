// SPDX-License-Identifier: MIT
#include <algorithm>

#include "tracer/base/directions.h"
#include "tracer/scene/scene.h"

namespace tracer {
namespace {

/// Up to so many are picked by power: a step in the tree takes longer than what it saves.
constexpr size_t few_lights = 8;

LightTree make_light_tree(const Mesh& mesh, const EmissiveTriangles& lights) {
  std::vector<LightBounds> bounds;
  bounds.reserve(lights.triangles.size());
  for (size_t i = 0; i < lights.triangles.size(); ++i) {
    const uint32_t triangle = lights.triangles[i];
    bounds.push_back({.box = mesh.triangle_bounds(triangle),
                      .normal = unit_or(triangle_at(mesh, triangle).area_normal(), {0, 1, 0}),
                      .power = lights.probabilities[i]});
  }
  return LightTree(bounds);
}

bool emits(const Material& material) {
  // What a texture or chance decides is found by scattered rays alone.
  return material.map(MapSlot::emission).empty() && is_opaque(material) &&
         luminance(Vec3d(material.emission)) > 0;
}

}  // namespace

EmissiveTriangles make_emissive_triangles(const Mesh& mesh,
                                          const std::vector<Material>& materials) {
  EmissiveTriangles lights;
  if (std::none_of(materials.begin(), materials.end(), emits)) return lights;
  double total = 0;
  for (uint32_t i = 0; i < mesh.triangle_count(); ++i) {
    const Material& material = materials[mesh.material_of(i)];
    if (!emits(material)) continue;
    const double power = triangle_at(mesh, i).area() * luminance(Vec3d(material.emission));
    if (!(power > 0) || !std::isfinite(power)) continue;
    total += power;
    lights.triangles.push_back(i);
    lights.probabilities.push_back(power);
    lights.cumulative.push_back(total);
  }
  for (double& probability : lights.probabilities) probability /= total;
  for (double& cumulative : lights.cumulative) cumulative /= total;
  if (lights.triangles.size() > few_lights) lights.tree = make_light_tree(mesh, lights);
  return lights;
}

}  // namespace tracer
