// SPDX-License-Identifier: MIT
#include "tracer/scene/scene.h"

namespace tracer {

EmissiveTriangles make_emissive_triangles(const Mesh& mesh,
                                          const std::vector<Material>& materials) {
  EmissiveTriangles lights;
  double total = 0;
  for (uint32_t i = 0; i < mesh.triangle_count(); ++i) {
    const Material& material = materials[mesh.material_of(i)];
    const double radiance = luminance(Vec3d(material.emission));
    if (!(radiance > 0) || !material.map(MapSlot::emission).empty()) continue;
    const double power = triangle_at(mesh, i).area() * radiance;
    if (!(power > 0) || !std::isfinite(power)) continue;
    total += power;
    lights.triangles.push_back(i);
    lights.probabilities.push_back(power);
    lights.cumulative.push_back(total);
  }
  for (double& probability : lights.probabilities) probability /= total;
  for (double& cumulative : lights.cumulative) cumulative /= total;
  return lights;
}

}  // namespace tracer
