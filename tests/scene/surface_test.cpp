// SPDX-License-Identifier: MIT
#include <random>

#include <gtest/gtest.h>

#include "tests/support/worlds.h"
#include "tracer/base/directions.h"
#include "tracer/render/sampling.h"

namespace tracer {
namespace {

using test::Triangles;

class Random {
 public:
  explicit Random(uint64_t seed) : engine_(seed) {}
  double next() { return std::uniform_real_distribution<double>(0, 1)(engine_); }
  Vec2d next_2d() { return {next(), next()}; }

 private:
  std::mt19937_64 engine_;
};

/// A hit of the triangle at a point picked by area.
Hit random_hit(const Mesh& mesh, Random& random) {
  const auto primitive = static_cast<uint32_t>(random.next() * mesh.triangle_count());
  const Vec2d weights = sample_triangle(random.next_2d());
  return {.t = 1, .u = weights.x, .v = weights.y, .primitive = primitive};
}

/// Of rays that leave the outside of a convex mesh, half of them close to grazing: how many meet
/// the mesh again.
int count_acne(const World& world, int ray_count, uint64_t seed) {
  const StopFlag never;
  RayCaster rays(*world.accel, never);
  Random random(seed);
  const Mesh& mesh = *world.scene->mesh;
  int acne = 0;
  for (int i = 0; i < ray_count; ++i) {
    const Hit hit = random_hit(mesh, random);
    const Vec3d outward = triangle_at(mesh, hit.primitive).area_normal();
    const Surface surface = surface_at(*world.scene, hit, -outward);
    Vec2d u = random.next_2d();
    if (i % 2 == 0) u.x = 1 - 1e-6 * u.x;
    const Vec3f direction(sample_cosine_hemisphere(surface.geometric_normal, u));
    if (!(glm::dot(Vec3d(direction), surface.geometric_normal) > 0)) continue;
    if (rays.occluded({.origin = offset_origin(surface), .direction = direction})) ++acne;
  }
  return acne;
}

TEST(Surface, rays_leave_convex_meshes_of_every_size_and_place_without_meeting_them_again) {
  for (const double size : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    for (const double offset : {0.0, 0.37, 1e3}) {
      Triangles sphere;
      const Vec3d center = offset * size * Vec3d(1, -0.7, 0.3);
      sphere.add_sphere(center, size, 3);
      const World world = test::make_world(sphere, {test::diffuse(1)}, Vec3d(1));
      EXPECT_EQ(count_acne(world, 20'000, 7), 0) << size << " at " << offset;

      Triangles box;
      box.add_box(Vec3f(center), Vec3f(center + size * Vec3d(1, 2, 0.1)));
      const World box_world = test::make_world(box, {test::diffuse(1)}, Vec3d(1));
      EXPECT_EQ(count_acne(box_world, 20'000, 8), 0) << size << " at " << offset;
    }
  }
}

TEST(Surface, rays_leave_a_tilted_quad_without_meeting_its_other_half) {
  Random random(9);
  for (int i = 0; i < 200; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(random.next() * 40) - 20);
    const auto any = [&] {
      return scale * Vec3d(random.next() - 0.5, random.next() - 0.5, random.next() - 0.5);
    };
    const Vec3d corner = 10.0 * any();
    const Vec3d side = any();
    const Vec3d other = any();
    Triangles quad;
    quad.add(Vec3f(corner), Vec3f(corner + side), Vec3f(corner + side + other));
    quad.add(Vec3f(corner), Vec3f(corner + side + other), Vec3f(corner + other));
    const World world = test::make_world(quad, {test::diffuse(1)}, Vec3d(1));
    ASSERT_EQ(count_acne(world, 500, static_cast<uint64_t>(i)), 0);
  }
}

TEST(Surface, a_plane_through_the_origin_of_coordinates_is_left_too) {
  Triangles ground;
  ground.add_quad({-1e4f, 0, -1e4f}, {0, 0, 2e4f}, {2e4f, 0, 0});
  const World world = test::make_world(ground, {test::diffuse(1)}, Vec3d(1));
  EXPECT_EQ(count_acne(world, 50'000, 10), 0);
  // And by far less than what lies on it is large.
  const Surface surface =
      surface_at(*world.scene, {.t = 1, .u = 0.5, .v = 0, .primitive = 0}, {0, -1, 0});
  EXPECT_LT(surface.clearance, 1e-8);
}

TEST(Surface, offsets_are_of_the_size_of_the_rounding_at_every_scale) {
  for (const double size : {1e-6, 1.0, 1e6}) {
    Triangles sphere;
    sphere.add_sphere(Vec3d(0), size, 2);
    const World world = test::make_world(sphere, {test::diffuse(1)}, Vec3d(1));
    const Surface surface =
        surface_at(*world.scene, {.t = 1, .u = 0.3, .v = 0.3, .primitive = 5}, Vec3d(-1, -1, -1));
    EXPECT_LT(surface.clearance / size, 2e-6);
  }
}

TEST(Surface, normals_face_the_side_that_the_ray_came_from) {
  Triangles triangles;
  triangles.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const World world = test::make_world(triangles, {test::diffuse(1)}, Vec3d(1));
  const Hit hit{.t = 1, .u = 0.25, .v = 0.25, .primitive = 0};
  EXPECT_EQ(surface_at(*world.scene, hit, {0, 0, -2}).geometric_normal, Vec3d(0, 0, 1));
  EXPECT_EQ(surface_at(*world.scene, hit, {0.5, 0, 2}).geometric_normal, Vec3d(0, 0, -1));
  EXPECT_EQ(surface_at(*world.scene, hit, {0, 0, 2}).shading_normal, Vec3d(0, 0, -1));
}

TEST(Surface, vertex_colours_are_interpolated_and_multiply_the_albedo) {
  Triangles triangles;
  triangles.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  triangles.mesh.colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const World world = test::make_world(triangles, {test::diffuse(0.5)}, Vec3d(1));
  const Vec3d albedo =
      surface_at(*world.scene, {.t = 1, .u = 0.25, .v = 0.5, .primitive = 0}, {0, 0, -1})
          .scattering.base_color;
  EXPECT_EQ(albedo, Vec3d(0.125, 0.125, 0.25));
}

TEST(Surface, a_texture_multiplies_the_albedo_where_all_corners_have_coordinates) {
  Triangles triangles;
  triangles.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  triangles.mesh.texcoords = {{0.5f, 0.5f}};
  triangles.mesh.texcoord_indices = {{0, 0, 0}, {0, no_index, 0}};
  Material material = test::diffuse(0.5);
  material.diffuse_texture = 0;
  World world = test::make_world(triangles, {material}, Vec3d(1));
  Scene scene = *world.scene;
  scene.textures = std::make_shared<std::vector<Texture>>(
      std::vector<Texture>{{.width = 1, .height = 1, .texels = {Vec3f(0.5f, 1, 4)}}});
  const auto albedo_of = [&](uint32_t primitive) {
    return surface_at(scene, {.t = 1, .u = 0.25, .v = 0.25, .primitive = primitive}, {0, 0, -1})
        .scattering.base_color;
  };
  EXPECT_EQ(albedo_of(0), Vec3d(0.25, 0.5, 1));  // never more than arrives
  EXPECT_EQ(albedo_of(1), Vec3d(0.5));
}

}  // namespace
}  // namespace tracer
