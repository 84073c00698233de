// SPDX-License-Identifier: MIT
#include "tracer/render/light_sampling.h"

#include <algorithm>

#include "tracer/base/directions.h"
#include "tracer/render/sampling.h"

namespace tracer {
namespace {

/// From area to solid angle: distance^2 / (cosine * area).
double solid_angle_pdf(double area, double distance, double cosine) {
  return cosine > 0 && area > 0 ? distance * distance / (cosine * area) : 0;
}

/// The ray from the surface to `point` on a light whose unit normal towards the surface is given.
/// The ray ends before the light's plane even after its direction is rounded to float.
Ray make_shadow_ray(const Surface& surface, const Vec3d& point, const Vec3d& light_normal,
                    double light_clearance) {
  const Vec3f origin = offset_origin(surface);
  const Vec3d reach = glm::abs(point - Vec3d(origin));
  const double rounding = 2 * 0x1p-24 * glm::dot(glm::abs(light_normal), reach);
  const Vec3d end = point + (light_clearance + rounding) * light_normal;
  return {.origin = origin, .direction = Vec3f(end - Vec3d(origin)), .t_max = 1};
}

}  // namespace

LightPick pick_light(const EmissiveTriangles& lights, double u) {
  const auto light = std::upper_bound(lights.cumulative.begin(), lights.cumulative.end(), u);
  const auto i = std::min<size_t>(light - lights.cumulative.begin(), lights.triangles.size() - 1);
  return {lights.triangles[i], lights.probabilities[i]};
}

LightSample sample_light(const Scene& scene, const Surface& surface, Sampler& sampler) {
  const auto [index, probability] = pick_light(*scene.lights, sampler.next());
  const Triangle triangle = triangle_at(*scene.mesh, index);
  const Vec2d weights = sample_triangle(sampler.next_2d());
  const Vec3d point = triangle.at(weights.x, weights.y);
  const Vec3d to_light = point - surface.position;

  LightSample sample;
  sample.triangle = index;
  sample.direction = unit_or(to_light, surface.geometric_normal);
  sample.radiance = Vec3d((*scene.materials)[scene.mesh->material_of(index)].emission);
  Vec3d normal = unit_or(triangle.area_normal(), -sample.direction);
  if (glm::dot(normal, sample.direction) > 0) normal = -normal;
  sample.pdf =
      probability *
      solid_angle_pdf(triangle.area(), glm::length(to_light), -glm::dot(normal, sample.direction));
  sample.shadow_ray = make_shadow_ray(surface, point, normal, clearance_of(triangle, normal));
  return sample;
}

double pdf_light(const Scene& scene, uint32_t triangle, const Ray& ray, double t) {
  const std::vector<uint32_t>& lights = scene.lights->triangles;
  const auto light = std::lower_bound(lights.begin(), lights.end(), triangle);
  if (light == lights.end() || *light != triangle) return 0;
  const Triangle corners = triangle_at(*scene.mesh, triangle);
  const Vec3d direction = unit_or(Vec3d(ray.direction), Vec3d(0));
  const Vec3d normal = unit_or(corners.area_normal(), Vec3d(0));
  return scene.lights->probabilities[light - lights.begin()] *
         solid_angle_pdf(corners.area(), t * glm::length(Vec3d(ray.direction)),
                         std::abs(glm::dot(normal, direction)));
}

}  // namespace tracer
