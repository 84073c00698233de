// SPDX-License-Identifier: MIT
#include "tracer/render/light_sampling.h"

#include <algorithm>

#include "tracer/render/sampling.h"

namespace tracer {
namespace {

/// From area to solid angle: distance^2 / (cosine * area).
double solid_angle_pdf(double area, double distance, double cosine) {
  return cosine > 0 && area > 0 ? distance * distance / (cosine * area) : 0;
}

LightTree::Pick pick_by_power(const EmissiveTriangles& lights, double u) {
  const auto found = std::upper_bound(lights.cumulative.begin(), lights.cumulative.end(), u);
  const auto light =
      std::min<size_t>(found - lights.cumulative.begin(), lights.triangles.size() - 1);
  return {static_cast<uint32_t>(light), lights.probabilities[light]};
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

LightReceiver receiver_of(const Surface& surface) {
  return {offset_origin(surface), Vec3f(surface.shading_normal)};
}

Lights::Lights(const World& world, const RenderSettings& settings)
    : scene_(*world.scene), triangles_(*world.scene->lights), sky_(world, settings) {
  const bool has_triangles = !triangles_.empty();
  const bool has_sky = sky_.is_sampled();
  sky_share_ = has_sky ? (has_triangles ? 0.5 : 1) : 0;
  triangle_share_ = has_triangles ? 1 - sky_share_ : 0;
}

LightSample Lights::sample(const Surface& surface, double which, const Vec2d& where) const {
  if (which < sky_share_) return sample_sky(surface, where);
  const double rest = (which - sky_share_) / triangle_share_;
  return sample_triangle(surface, pick_triangle(surface, rest), where);
}

LightSample Lights::sample_sky(const Surface& surface, const Vec2d& where) const {
  const Environment::Sample found = sky_.sample(where);
  LightSample sample;
  sample.triangle = no_primitive;
  sample.direction = found.direction;
  sample.radiance = sky_.radiance(found.direction);
  sample.pdf = sky_share_ * found.pdf;
  sample.shadow_ray = {.origin = offset_origin(surface), .direction = Vec3f(found.direction)};
  return sample;
}

LightTree::Pick Lights::pick_triangle(const Surface& surface, double u) const {
  if (triangles_.tree.empty()) return pick_by_power(triangles_, u);
  return triangles_.tree.pick(receiver_of(surface), u);
}

double Lights::probability_of(const LightReceiver& receiver, uint32_t light) const {
  if (triangles_.tree.empty()) return triangles_.probabilities[light];
  return triangles_.tree.probability(receiver, light);
}

LightSample Lights::sample_triangle(const Surface& surface, const LightTree::Pick& pick,
                                    const Vec2d& where) const {
  const uint32_t index = triangles_.triangles[pick.light];
  const Triangle triangle = triangle_at(*scene_.mesh, index);
  const Vec2d weights = tracer::sample_triangle(where);
  const Vec3d point = triangle.at(weights.x, weights.y);
  const Vec3d to_light = point - surface.position;

  LightSample sample;
  sample.triangle = index;
  sample.direction = unit_or(to_light, surface.geometric_normal);
  sample.radiance = Vec3d((*scene_.materials)[scene_.mesh->material_of(index)].emission);
  Vec3d normal = unit_or(triangle.area_normal(), -sample.direction);
  if (glm::dot(normal, sample.direction) > 0) normal = -normal;
  sample.pdf =
      triangle_share_ * pick.probability *
      solid_angle_pdf(triangle.area(), glm::length(to_light), -glm::dot(normal, sample.direction));
  sample.shadow_ray = make_shadow_ray(surface, point, normal, clearance_of(triangle, normal));
  return sample;
}

double Lights::pdf(const LightReceiver& receiver, uint32_t triangle, const Ray& ray,
                   double t) const {
  const std::vector<uint32_t>& lights = triangles_.triangles;
  const auto light = std::lower_bound(lights.begin(), lights.end(), triangle);
  if (light == lights.end() || *light != triangle) return 0;
  const Triangle corners = triangle_at(*scene_.mesh, triangle);
  const Vec3d direction = unit_or(Vec3d(ray.direction), Vec3d(0));
  const Vec3d normal = unit_or(corners.area_normal(), Vec3d(0));
  return triangle_share_ * probability_of(receiver, static_cast<uint32_t>(light - lights.begin())) *
         solid_angle_pdf(corners.area(), t * glm::length(Vec3d(ray.direction)),
                         std::abs(glm::dot(normal, direction)));
}

}  // namespace tracer
