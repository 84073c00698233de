// SPDX-License-Identifier: MIT
#include "tracer/render/light_sampling.h"

#include <algorithm>
#include <array>

#include "tracer/base/directions.h"
#include "tracer/render/directions-inl.h"
#include "tracer/render/integrator.h"

namespace tracer {
namespace {

/// From area to solid angle: distance^2 / (cosine * area).
double solid_angle_pdf(double area, double distance, double cosine) {
  return cosine > 0 && area > 0 ? distance * distance / (cosine * area) : 0;
}

double rest_of(double place, double part) {
  return std::clamp(place / part, 0.0, 1 - 0x1p-53);
}

LightTree::Pick pick_by_power(const EmissiveTriangles& lights, double u) {
  // Few: more have a tree.
  size_t light = 0;
  while (light + 1 < lights.triangles.size() && lights.cumulative[light] <= u) ++light;
  const double before = light > 0 ? lights.cumulative[light - 1] : 0;
  return {static_cast<uint32_t>(light), lights.probabilities[light],
          rest_of(u - before, lights.probabilities[light])};
}

}  // namespace

LightReceiver receiver_of(const Surface& surface) {
  if (surface.scattering.transmission > 0) return {offset_origin(surface), Vec3f(0)};
  return {offset_origin(surface), Vec3f(surface.shading_normal)};
}

Lights::Lights(const World& world, const RenderSettings& settings)
    : scene_(*world.scene), triangles_(*world.scene->lights), sky_(world, settings) {
  const bool has_triangles = !triangles_.empty();
  const bool has_sky = sky_.is_sampled();
  sky_share_ = has_sky ? (has_triangles ? 0.5 : 1) : 0;
  triangle_share_ = has_triangles ? 1 - sky_share_ : 0;
}

Lights::Pick Lights::pick(const LightReceiver& receiver, double which) const {
  if (which < sky_share_) return {no_primitive, sky_share_, rest_of(which, sky_share_)};
  const LightTree::Pick pick =
      pick_triangle(receiver, rest_of(which - sky_share_, triangle_share_));
  return {triangles_.triangles[pick.light], triangle_share_ * pick.probability, pick.rest};
}

void Lights::pick(std::span<const LightReceiver> receivers, std::span<const double> which,
                  std::span<Pick> picks) const {
  if (sky_share_ > 0) {
    for (size_t i = 0; i < receivers.size(); ++i) picks[i] = pick(receivers[i], which[i]);
    return;
  }
  std::array<LightTree::Pick, SampleBlock::max_size> picked;
  if (triangles_.tree.empty()) {
    for (size_t i = 0; i < receivers.size(); ++i) picked[i] = pick_by_power(triangles_, which[i]);
  } else {
    triangles_.tree.pick(receivers, which, std::span(picked).first(receivers.size()));
  }
  for (size_t i = 0; i < receivers.size(); ++i) {
    picks[i] = {triangles_.triangles[picked[i].light], picked[i].probability, picked[i].rest};
  }
}

LightSample Lights::sample(const Surface& surface, const Vec2d& u) const {
  const Pick pick = this->pick(receiver_of(surface), u.x);
  const Vec2d where(pick.rest, u.y);
  return pick.triangle == no_primitive ? sample_sky(surface, where)
                                       : sample_triangle(surface, pick, where);
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

LightTree::Pick Lights::pick_triangle(const LightReceiver& receiver, double u) const {
  if (triangles_.tree.empty()) return pick_by_power(triangles_, u);
  return triangles_.tree.pick(receiver, u);
}

double Lights::probability_of(const LightReceiver& receiver, uint32_t light) const {
  if (triangles_.tree.empty()) return triangles_.probabilities[light];
  return triangles_.tree.probability(receiver, light);
}

LightSample Lights::sample_triangle(const Surface& surface, const Pick& pick,
                                    const Vec2d& where) const {
  using namespace HWY_NAMESPACE;
  const Vec3f origin = offset_origin(surface);
  const LightPoint<double> point = light_point<double>(
      corners_of(triangle_at(*scene_.mesh, pick.triangle)), where.x, where.y,
      {components(surface.position), components(surface.geometric_normal), surface.clearance},
      components(Vec3d(origin)));
  const uint32_t material = scene_.mesh->material_of(pick.triangle);
  return {.shadow_ray = {.origin = origin,
                         .direction = Vec3f(joined(point.end) - Vec3d(origin)),
                         .t_max = 1},
          .direction = joined(point.direction),
          .radiance = Vec3d((*scene_.materials)[material].emission),
          .pdf = pick.probability * point.pdf,
          .triangle = pick.triangle};
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
