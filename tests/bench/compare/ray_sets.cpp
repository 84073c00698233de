// SPDX-License-Identifier: MIT
#include "tests/bench/compare/ray_sets.h"

#include <cmath>
#include <numbers>

#include "tests/support/random_source.h"
#include "tracer/base/directions.h"
#include "tracer/base/trigonometry.h"

namespace bench {
namespace {

using tracer::Hit;
using tracer::Mesh;
using tracer::Ray;
using tracer::Vec2i;
using tracer::Vec3d;
using tracer::Vec3f;
using tracer::Vec3u;

constexpr int block_side_px = 16;
constexpr double half_width = 0.4;  // of the picture, in distances to the target

// Pixel of a block, Morton order: 16 rays in a row are 4x4 pixels, 64 are 8x8.
Vec2i pixel_in_block(int index) {
  Vec2i pixel(0);
  for (int bit = 0; bit < 4; ++bit) {
    pixel.x |= (index >> 2 * bit & 1) << bit;
    pixel.y |= (index >> (2 * bit + 1) & 1) << bit;
  }
  return pixel;
}

std::vector<Ray> camera_rays(const Scene& scene, int side_px) {
  const Vec3d forward = Vec3d(scene.target) - Vec3d(scene.eye);
  const double reach = half_width * glm::length(forward);
  const Vec3d right = reach * glm::normalize(glm::cross(forward, Vec3d(0, 1, 0)));
  const Vec3d up = reach * glm::normalize(glm::cross(right, forward));
  std::vector<Ray> rays;
  rays.reserve(static_cast<size_t>(side_px) * side_px);
  for (int y = 0; y < side_px; y += block_side_px) {
    for (int x = 0; x < side_px; x += block_side_px) {
      for (int i = 0; i < static_cast<int>(rays_a_block); ++i) {
        const Vec2i pixel = Vec2i(x, y) + pixel_in_block(i);
        const double across = (2 * pixel.x + 1.0) / side_px - 1;
        const double down = (2 * pixel.y + 1.0) / side_px - 1;
        rays.push_back({.origin = scene.eye,
                        .direction = Vec3f(glm::normalize(forward + across * right - down * up))});
      }
    }
  }
  return rays;
}

/// Where a ray arrived: a point off the surface, on the ray's side, and the normal there.
struct Arrival {
  Vec3f point;
  Vec3d normal;
};

Arrival arrive(const Mesh& mesh, const Ray& ray, const Hit& hit) {
  const Vec3u& index = mesh.triangles[hit.primitive];
  const Vec3d v0 = mesh.positions[index.x];
  const Vec3d edge1 = Vec3d(mesh.positions[index.y]) - v0;
  const Vec3d edge2 = Vec3d(mesh.positions[index.z]) - v0;
  const Vec3d way = hit.t * Vec3d(ray.direction);
  Vec3d normal = tracer::unit_or(glm::cross(edge1, edge2), -glm::normalize(way));
  if (glm::dot(normal, way) > 0) normal = -normal;
  const Vec3d point = Vec3d(ray.origin) + way;
  const double offset = 0x1p-13 * glm::length(way) + 0x1p-16 * tracer::max_abs(point);
  return {Vec3f(point + offset * normal), normal};
}

std::vector<Arrival> arrivals_of(const tracer::Accel& accel, const std::vector<Ray>& rays) {
  const tracer::StopFlag stop;
  tracer::RayCaster caster(accel, stop);
  std::vector<Arrival> arrivals;
  for (const Ray& ray : rays) {
    const Hit hit = caster.closest_hit(ray);
    if (hit.is_hit()) arrivals.push_back(arrive(*accel.mesh, ray, hit));
  }
  return arrivals;
}

std::vector<Ray> shadow_rays(const std::vector<Arrival>& arrivals, const Vec3f& light) {
  std::vector<Ray> rays;
  for (const Arrival& arrival : arrivals) {
    rays.push_back(
        {.origin = arrival.point, .direction = light - arrival.point, .t_min = 0, .t_max = 1});
  }
  return rays;
}

std::vector<Ray> diffuse_rays(const std::vector<Arrival>& arrivals) {
  tracer::RandomSource random(2);
  std::vector<Ray> rays;
  for (const Arrival& arrival : arrivals) {
    const double radius_squared = random.unit();
    const tracer::CosSin angle = tracer::cos_sin_of_turns(random.unit());
    const tracer::Tangents tangents = tracer::tangents_of(arrival.normal);
    const Vec3d direction =
        std::sqrt(radius_squared) * (angle.cos * tangents.x + angle.sin * tangents.y) +
        std::sqrt(1 - radius_squared) * arrival.normal;
    rays.push_back({.origin = arrival.point, .direction = Vec3f(direction)});
  }
  return rays;
}

Vec3d point_on_sphere(tracer::RandomSource& random) {
  const double z = 2.0 * random.unit() - 1;
  const tracer::CosSin angle = tracer::cos_sin_of_turns(random.unit());
  const double radius = std::sqrt(1 - z * z);
  return {radius * angle.cos, radius * angle.sin, z};
}

std::vector<Ray> random_rays(const Mesh& mesh, size_t count) {
  tracer::RandomSource random(3);
  const Vec3d center = mesh.bounds.center();
  const double radius = 0.5 * glm::length(mesh.bounds.extent());
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const Vec3d from = point_on_sphere(random);
    const Vec3d way = point_on_sphere(random) - from;
    if (glm::length(way) == 0) continue;
    rays.push_back(
        {.origin = Vec3f(center + radius * from), .direction = Vec3f(glm::normalize(way))});
  }
  return rays;
}

}  // namespace

std::vector<RaySet> make_ray_sets(const Scene& scene, const tracer::Accel& accel, int side_px) {
  std::vector<Ray> camera = camera_rays(scene, side_px);
  const std::vector<Arrival> arrivals = arrivals_of(accel, camera);
  const size_t count = camera.size();
  std::vector<RaySet> sets;
  sets.push_back({&ray_kinds[0], std::move(camera)});
  sets.push_back({&ray_kinds[1], shadow_rays(arrivals, scene.light)});
  sets.push_back({&ray_kinds[2], diffuse_rays(arrivals)});
  sets.push_back({&ray_kinds[3], random_rays(*scene.mesh, count)});
  return sets;
}

RaySet thinned(const RaySet& set, size_t stride) {
  RaySet kept{set.kind, {}};
  for (size_t first = 0; first < set.rays.size(); first += stride * rays_a_block) {
    const size_t last = std::min(first + rays_a_block, set.rays.size());
    kept.rays.insert(kept.rays.end(), set.rays.begin() + static_cast<ptrdiff_t>(first),
                     set.rays.begin() + static_cast<ptrdiff_t>(last));
  }
  return kept;
}

}  // namespace bench
