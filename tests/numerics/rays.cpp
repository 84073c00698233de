// SPDX-License-Identifier: MIT
#include "tests/numerics/rays.h"

#include <algorithm>
#include <cmath>

#include "tests/numerics/stress.h"
#include "tests/support/test_meshes.h"

namespace tracer::stress {
namespace {

float size_of(const Mesh& mesh) {
  return static_cast<float>(max_abs(mesh.bounds.extent()));
}

bool comes_up(RandomSource& random, int once_in) {
  return random.integer(1, once_in) == 1;
}

float power_of_two(RandomSource& random, float least_exponent, float most_exponent) {
  return std::exp2(random.between(least_exponent, most_exponent));
}

// Neighbours in the mesh's order are mostly neighbours in space.
uint32_t random_triangle_near(const Mesh& mesh, uint32_t triangle, RandomSource& random) {
  const auto reach = static_cast<uint32_t>(random.integer(0, 20));
  return (triangle + reach) % mesh.triangle_count();
}

Ray from_point(const Mesh& mesh, const Vec3f& origin, uint32_t near, RandomSource& random) {
  const Vec3f target = random_target(mesh, random_triangle_near(mesh, near, random), random);
  return {.origin = origin, .direction = target - origin};
}

Ray to_point(const Mesh& mesh, const Vec3f& end, uint32_t near, RandomSource& random) {
  const Vec3f target = random_target(mesh, random_triangle_near(mesh, near, random), random);
  const Vec3f origin = comes_up(random, 4) ? target : end + 1.5f * (target - end);
  return {.origin = origin, .direction = end - origin, .t_max = 1};
}

Ray along_axis(const Mesh& mesh, RandomSource& random) {
  const auto zero = [&] { return comes_up(random, 2) ? 0.0f : -0.0f; };
  Vec3f direction(zero(), zero(), zero());
  const int axis = random.integer(0, 2);
  direction[axis] = comes_up(random, 2) ? 1.0f : -1.0f;
  Vec3f origin = random_target(mesh, random_triangle(mesh, random), random);
  origin[axis] -= direction[axis] * size_of(mesh) * static_cast<float>(random.integer(0, 2));
  return {.origin = origin, .direction = direction};
}

Ray from_afar(const Mesh& mesh, RandomSource& random) {
  const Vec3f target = random_target(mesh, random_triangle(mesh, random), random);
  const float distance = size_of(mesh) * power_of_two(random, 5, 20);
  const Vec3f origin = target + distance * random.vector(-1, 1);
  return {.origin = origin, .direction = target - origin};
}

Ray from_surface(const Mesh& mesh, RandomSource& random) {
  const Vec3f origin = random_target(mesh, random_triangle(mesh, random), random);
  const Vec3f other = random_target(mesh, random_triangle(mesh, random), random);
  return {.origin = origin,
          .direction = comes_up(random, 2) ? other - origin : random.vector(-1, 1)};
}

}  // namespace

Box TestTriangle::bounds() const {
  Box box;
  for (const Vec3f& vertex : {v0, v1, v2}) box.extend(vertex);
  return box;
}

std::string literal(const TestTriangle& triangle) {
  return literal(triangle.v0) + ", " + literal(triangle.v1) + ", " + literal(triangle.v2);
}

bool moeller_trumbore(const Ray& ray, const TestTriangle& triangle) {
  const Vec3f edge1 = triangle.v1 - triangle.v0;
  const Vec3f edge2 = triangle.v2 - triangle.v0;
  const Vec3f p = glm::cross(ray.direction, edge2);
  const float determinant = glm::dot(edge1, p);
  if (determinant == 0) return false;
  const Vec3f to_origin = ray.origin - triangle.v0;
  const float u = glm::dot(to_origin, p) / determinant;
  const Vec3f q = glm::cross(to_origin, edge1);
  const float v = glm::dot(ray.direction, q) / determinant;
  const float t = glm::dot(edge2, q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && static_cast<double>(t) <= ray.t_max;
}

std::optional<float> pluecker(const Ray& ray, const TestTriangle& triangle) {
  const Vec3f v0 = triangle.v0 - ray.origin;
  const Vec3f v1 = triangle.v1 - ray.origin;
  const Vec3f v2 = triangle.v2 - ray.origin;
  const auto side = [&](const Vec3f& from, const Vec3f& to) {
    return glm::dot(glm::cross(to - from, to + from), ray.direction);
  };
  const float u = side(v0, v2);
  const float v = side(v1, v0);
  const float w = side(v2, v1);
  const float tolerance = std::numeric_limits<float>::epsilon() * std::abs(u + v + w);
  if (std::min({u, v, w}) < -tolerance && std::max({u, v, w}) > tolerance) return {};
  const Vec3f normal = glm::cross(v2 - v0, v1 - v0);
  const float t = glm::dot(v0, normal) / glm::dot(normal, ray.direction);
  return t >= 0 && std::isfinite(t) ? std::optional(t) : std::nullopt;
}

bool naive_slabs(const Ray& ray, const Box& box) {
  const Vec3f inverse = 1.0f / ray.direction;
  const Vec3f to_min = (box.min - ray.origin) * inverse;
  const Vec3f to_max = (box.max - ray.origin) * inverse;
  const Vec3f near = glm::min(to_min, to_max);
  const Vec3f far = glm::max(to_min, to_max);
  const float entry = std::max({near.x, near.y, near.z, 0.0f});
  return entry <= std::min({far.x, far.y, far.z});
}

RandomAxes::RandomAxes(RandomSource& random) {
  Vec3d towards(random.vector(-1, 1));
  while (glm::length(towards) < 0.1) towards = Vec3d(random.vector(-1, 1));
  z = glm::normalize(towards);
  const Vec3d least = std::abs(z.x) < 0.7 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  x = glm::normalize(glm::cross(least, z));
  y = glm::cross(z, x);
}

TestTriangle triangle_of(const Mesh& mesh, uint32_t triangle) {
  const Vec3u& corners = mesh.triangles[triangle];
  return {mesh.positions[corners.x], mesh.positions[corners.y], mesh.positions[corners.z]};
}

uint32_t random_triangle(const Mesh& mesh, RandomSource& random) {
  return static_cast<uint32_t>(random.integer(0, static_cast<int>(mesh.triangle_count()) - 1));
}

Vec3f random_target(const Mesh& mesh, uint32_t triangle, RandomSource& random) {
  const TestTriangle corners = triangle_of(mesh, triangle);
  const float along = random.unit();
  const float across = (1 - along) * random.unit();
  switch (random.integer(0, 3)) {
    case 0:
      return corners.v0;
    case 1:
      return glm::mix(corners.v1, corners.v2, along);
    case 2:
      return glm::mix(corners.v0, corners.v2, along);
    default:
      return corners.v0 + along * (corners.v1 - corners.v0) + across * (corners.v2 - corners.v0);
  }
}

Mesh lattice_ball(int cells_a_side, uint32_t seed) {
  Mesh mesh = rough_ball(cells_a_side, 0.05f, seed);
  for (Vec3f& position : mesh.positions) position = 16.0f * glm::round(256.0f * position);
  return make_test_mesh(std::move(mesh.positions), std::move(mesh.triangles));
}

std::vector<Ray> probing_rays(const Mesh& mesh, uint64_t group, RandomSource& random) {
  const uint32_t near = random_triangle(mesh, random);
  const float reach = size_of(mesh) * power_of_two(random, -4, 4);
  const Vec3f point = mesh.bounds.center() + reach * random.vector(-1, 1);
  std::vector<Ray> rays;
  while (rays.size() < rays_a_group) {
    const auto make_ray = [&] {
      switch (group % 6) {
        case 0:
          return from_point(mesh, point, near, random);
        case 1:
          return to_point(mesh, point, near, random);
        case 2:
          return along_axis(mesh, random);
        case 3:
          return from_afar(mesh, random);
        case 4:
          return from_surface(mesh, random);
        default:
          return from_point(mesh, mesh.bounds.center() + reach * random.vector(-1, 1),
                            random_triangle(mesh, random), random);
      }
    };
    Ray ray = make_ray();
    if (ray.direction == Vec3f(0)) continue;
    if (comes_up(random, 16)) ray.t_max = static_cast<double>(2 * random.unit());
    if (comes_up(random, 16)) ray.t_min = std::min(ray.t_max, static_cast<double>(random.unit()));
    rays.push_back(ray);
  }
  return rays;
}

}  // namespace tracer::stress
