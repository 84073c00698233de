// SPDX-License-Identifier: MIT
#include "tests/support/worlds.h"

#include <cmath>
#include <optional>

namespace tracer::test {

void Triangles::add(const Vec3f& a, const Vec3f& b, const Vec3f& c, uint32_t material) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (const Vec3f& point : {a, b, c}) {
    mesh.positions.push_back(point);
    mesh.bounds.extend(point);
  }
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.materials.push_back(material);
}

void Triangles::add_quad(const Vec3f& corner, const Vec3f& side, const Vec3f& other_side,
                         uint32_t material) {
  add(corner, corner + side, corner + side + other_side, material);
  add(corner, corner + side + other_side, corner + other_side, material);
}

void Triangles::add_box(const Vec3f& min, const Vec3f& max, uint32_t material) {
  const Vec3f x(max.x - min.x, 0, 0);
  const Vec3f y(0, max.y - min.y, 0);
  const Vec3f z(0, 0, max.z - min.z);
  add_quad(min, y, x, material);
  add_quad(min, x, z, material);
  add_quad(min, z, y, material);
  add_quad(min + z, x, y, material);
  add_quad(min + y, z, x, material);
  add_quad(min + x, y, z, material);
}

namespace {
void add_patch(Triangles& out, const Vec3d& center, double radius, int level, uint32_t material,
               const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  if (level == 0) {
    const auto point = [&](const Vec3d& v) { return Vec3f(center + radius * v); };
    out.add(point(a), point(b), point(c), material);
    return;
  }
  const Vec3d ab = glm::normalize(a + b);
  const Vec3d bc = glm::normalize(b + c);
  const Vec3d ca = glm::normalize(c + a);
  add_patch(out, center, radius, level - 1, material, a, ab, ca);
  add_patch(out, center, radius, level - 1, material, b, bc, ab);
  add_patch(out, center, radius, level - 1, material, c, ca, bc);
  add_patch(out, center, radius, level - 1, material, ab, bc, ca);
}
}  // namespace

void Triangles::add_sphere(const Vec3d& center, double radius, int level, uint32_t material) {
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3d x(octant & 1 ? -1 : 1, 0, 0);
    const Vec3d y(0, octant & 2 ? -1 : 1, 0);
    const Vec3d z(0, 0, octant & 4 ? -1 : 1);
    const bool is_mirrored = x.x * y.y * z.z < 0;
    add_patch(*this, center, radius, level, material, x, is_mirrored ? z : y, is_mirrored ? y : z);
  }
}

World make_world(const Triangles& triangles, const std::vector<Material>& materials,
                 const Vec3d& sky, Tracing tracing) {
  auto scene = std::make_shared<Scene>();
  scene->mesh = std::make_shared<Mesh>(triangles.mesh);
  scene->materials = std::make_shared<std::vector<Material>>(materials);
  scene->surfaces = summarize(materials);
  scene->textures = std::make_shared<std::vector<Texture>>();
  scene->lights =
      std::make_shared<EmissiveTriangles>(make_emissive_triangles(*scene->mesh, materials));
  Progress progress;
  std::optional<BvhTree> tree;
  if (tracing == Tracing::tree) {
    tree = builders().front().build(primitive_boxes(*scene->mesh), {}, progress);
  }
  const auto accel = std::make_shared<Accel>(
      make_accel(scene->mesh, std::move(tree), layouts().front(), progress));
  return {.scene = scene, .accel = accel, .camera = {}, .sky = sky};
}

void set_camera(World& world, const Camera& camera, Vec2i size_px) {
  world.camera = make_camera_frame(camera, size_px, world.scene->mesh->origin);
}

World make_room(Vec2i size_px, Tracing tracing, int ball_level) {
  Triangles triangles;
  triangles.add_quad({-3, -1, -3}, {0, 0, 6}, {6, 0, 0}, 0);
  triangles.add_quad({-3, -1, -3}, {6, 0, 0}, {0, 4, 0}, 0);
  triangles.add_quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, 1);
  triangles.add_sphere({0.2, 0, 0.3}, 1, ball_level, 2);
  World world = make_world(triangles, {diffuse(0.7), diffuse(0.1, 4), diffuse(0.5)},
                           Vec3d(0.2, 0.3, 0.5), tracing);
  set_camera(world, {.eye = {2, 1, 6}, .target = {0, 0.3, 0}}, size_px);
  return world;
}

Film render(const World& world, const Integrator& integrator, const RenderSettings& settings,
            Vec2i size_px, uint32_t sample_count) {
  Film film(size_px);
  const StopFlag never;
  for (Pass pass = first_pass; pass.sample < sample_count; pass = next_pass(pass)) {
    render_pass(world, integrator, settings, pass, film, never);
  }
  return film;
}

Estimate estimate(const World& world, const Integrator& integrator, const RenderSettings& settings,
                  uint32_t sample_count) {
  const StopFlag never;
  RayCaster rays(*world.accel, never);
  double sum = 0;
  double sum_of_squares = 0;
  for (uint32_t sample = 0; sample < sample_count; ++sample) {
    const double value =
        luminance(render_sample(world, integrator, settings, {0, 0}, sample, rays));
    sum += value;
    sum_of_squares += value * value;
  }
  const double mean = sum / sample_count;
  const double variance = std::max(0.0, sum_of_squares / sample_count - mean * mean);
  return {mean, std::sqrt(variance / sample_count)};
}

}  // namespace tracer::test
