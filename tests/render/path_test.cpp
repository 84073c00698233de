// SPDX-License-Identifier: MIT
#include "tracer/render/path.h"

#include <gtest/gtest.h>

#include "tests/support/path_strategies.h"
#include "tests/support/worlds.h"

namespace tracer {
namespace {

using test::by_lights;
using test::by_scattering;
using test::diffuse;
using test::estimate;
using test::Estimate;
using test::path;
using test::Triangles;

/// Inside a closed box that emits 1 everywhere, off the middle.
World furnace(double albedo) {
  Triangles triangles;
  triangles.add_box({-1, -2, -1.5f}, {1, 1, 2});
  World world = test::make_world(triangles, {diffuse(albedo, 1)}, Vec3d(0));
  test::set_camera(world, {.eye = {0.3, 0.2, 0.1}, .target = {-1, 0.5, -0.4}, .fov_degrees = 100},
                   {1, 1});
  return world;
}

double truncated_sum(double albedo, int bounces) {
  double sum = 0;
  for (int i = bounces; i >= 0; --i) sum = 1 + albedo * sum;
  return sum;
}

TEST(PathFurnace, a_closed_emitting_box_has_the_truncated_sum_of_its_albedo_in_every_sample) {
  const StopFlag never;
  const World world = furnace(0.5);
  RayCaster rays(*world.accel, never);
  // Up to the third scattering nothing is left to chance when lights are found by scattering.
  for (int bounces = 0; bounces <= 3; ++bounces) {
    for (uint32_t sample = 0; sample < 2000; ++sample) {
      const Vec3d radiance =
          render_sample(world, by_scattering, {.bounces = bounces}, {0, 0}, sample, rays);
      ASSERT_NEAR(radiance.x, truncated_sum(0.5, bounces), 1e-6);
    }
  }
}

TEST(PathFurnace, roulette_and_light_sampling_keep_the_mean) {
  for (const double albedo : {0.3, 0.8}) {
    const World world = furnace(albedo);
    for (const int bounces : {1, 2, 8, 40}) {
      for (const Integrator& integrator : {path(), by_lights, by_scattering}) {
        const Estimate result = estimate(world, integrator, {.bounces = bounces}, 20'000);
        EXPECT_NEAR(result.mean, truncated_sum(albedo, bounces), 4 * result.standard_error + 1e-6)
            << albedo << ' ' << bounces;
      }
    }
  }
}

TEST(PathFurnace, a_white_convex_body_under_a_white_sky_cannot_be_seen) {
  for (const double size : {1e-6, 1.0, 1e6}) {
    Triangles sphere;
    sphere.add_sphere(Vec3d(3, -2, 5) * size, size, 3);
    World world = test::make_world(sphere, {diffuse(1)}, Vec3d(1));
    const Camera camera{.eye = Vec3d(3, -2, 9) * size, .target = Vec3d(3, -2, 5) * size};
    test::set_camera(world, camera, {64, 64});
    const Film film = test::render(world, path(), {}, {64, 64}, 4);
    for (int i = 0; i < 64 * 64; ++i) ASSERT_EQ(film.mean(i % 64, i / 64), Vec3f(1)) << size;
  }
}

/// Part of the light leaving a small patch that a rectangle above it catches: parallel, at
/// `height`, one corner straight above the patch.
double corner_form_factor(double side, double other_side, double height) {
  const double a = side / height;
  const double b = other_side / height;
  const double root_a = std::sqrt(1 + a * a);
  const double root_b = std::sqrt(1 + b * b);
  return (a / root_a * std::atan(b / root_a) + b / root_b * std::atan(a / root_b)) /
         (2 * std::numbers::pi);
}

/// A square light of radiance 5 and side 1 at height 1 over a wide floor; the camera looks at the
/// floor below one of its corners from the side.
World lit_floor() {
  Triangles triangles;
  triangles.add_quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, 0);
  triangles.add_quad({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 1);
  World world = test::make_world(triangles, {diffuse(0.6), diffuse(0, 5)}, Vec3d(0));
  test::set_camera(world, {.eye = {-3, 2, 0.5}, .target = {0, 0, 0}, .fov_degrees = 1e-3}, {1, 1});
  return world;
}

TEST(Path, a_square_light_over_a_floor_gives_the_closed_form_by_each_way_of_finding_it) {
  const World world = lit_floor();
  const double expected = 0.6 * 5 * corner_form_factor(1, 1, 1);
  for (const Integrator& integrator : {path(), by_lights, by_scattering}) {
    const Estimate result = estimate(world, integrator, {.bounces = 1}, 200'000);
    EXPECT_NEAR(result.mean, expected, 4 * result.standard_error);
    EXPECT_LT(result.standard_error, 0.01 * expected);
  }
}

TEST(Path, light_sampling_with_weights_has_far_less_noise_than_scattering_alone) {
  const World world = lit_floor();
  EXPECT_LT(3 * estimate(world, path(), {.bounces = 1}, 20'000).standard_error,
            estimate(world, by_scattering, {.bounces = 1}, 20'000).standard_error);
}

TEST(Path, all_ways_of_finding_lights_agree_between_walls_with_lights_of_all_sizes) {
  Triangles triangles;
  triangles.add_box({-1, -1, -1}, {1, 1, 1}, 0);
  triangles.add_quad({-0.9f, 0.999f, -0.9f}, {1.8f, 0, 0}, {0, 0, 1.8f}, 1);
  triangles.add_quad({0.5f, -0.5f, 0.5f}, {0.05f, 0, 0}, {0, 0.04f, 0.01f}, 2);
  World world =
      test::make_world(triangles, {diffuse(0.7), diffuse(0.2, 1), diffuse(0.5, 40)}, Vec3d(0.3));
  const Camera camera{.eye = {-0.8, 0.3, 0.7}, .target = {0.4, -1, 0.2}, .fov_degrees = 5};
  test::set_camera(world, camera, {1, 1});
  const RenderSettings settings{.bounces = 5};
  const Estimate combined = estimate(world, path(), settings, 60'000);
  for (const Integrator& integrator : {by_lights, by_scattering}) {
    const Estimate other = estimate(world, integrator, settings, 60'000);
    EXPECT_NEAR(combined.mean, other.mean,
                4 * std::hypot(combined.standard_error, other.standard_error));
  }
}

TEST(Path, both_sides_of_a_light_emit_alike) {
  for (const double side : {1.0, -1.0}) {
    Triangles triangles;
    triangles.add_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0);
    World world = test::make_world(triangles, {diffuse(0.5, 7)}, Vec3d(0));
    test::set_camera(world, {.eye = {0, 0, side}, .fov_degrees = 10}, {1, 1});
    EXPECT_NEAR(estimate(world, path(), {}, 10).mean, 7, 1e-12);
  }
}

TEST(Path, a_light_in_a_plane_of_coordinates_does_not_hide_itself) {
  // Its clearance is tiny, and the rounding of a long ray's direction is not.
  Triangles triangles;
  triangles.add_quad({-1e-3f, 0, -1e-3f}, {2e-3f, 0, 0}, {0, 0, 2e-3f}, 1);
  triangles.add_quad({-500, -1000.3f, -500}, {0, 0, 1000}, {1000, 0, 0}, 0);
  World world = test::make_world(triangles, {diffuse(1), diffuse(0, 1e12)}, Vec3d(0));
  test::set_camera(world, {.eye = {0.1, -900, 3}, .target = {0.1, -1000.3, 3}, .fov_degrees = 10},
                   {1, 1});
  const double expected = 1e12 / std::numbers::pi * 4e-6 / (1000.3 * 1000.3);
  const Estimate result = estimate(world, by_lights, {.bounces = 1}, 20'000);
  EXPECT_NEAR(result.mean, expected, 0.01 * expected);
}

TEST(Path, without_bounces_only_what_shines_is_seen) {
  const World world = lit_floor();
  EXPECT_EQ(estimate(world, path(), {.bounces = 0}, 10).mean, 0);
}

TEST(Path, without_lights_there_are_no_shadow_rays) {
  Triangles triangles;
  triangles.add_sphere(Vec3d(0), 1, 3);
  World world = test::make_world(triangles, {diffuse(0.5)}, Vec3d(1));
  test::set_camera(world, {.eye = {0, 0, 4}, .fov_degrees = 1}, {1, 1});
  const StopFlag never;
  RayCaster rays(*world.accel, never);
  render_sample(world, path(), {}, {0, 0}, 0, rays);
  // The camera's ray, and one that leaves the convex body.
  EXPECT_EQ(rays.ray_count(), 2u);
}

TEST(Path, smooth_shading_lets_no_light_through_the_surface) {
  // Inside a closed black box with white light outside, whatever the normals are.
  Triangles triangles;
  triangles.add_sphere(Vec3d(0), 1, 1);
  World world = test::make_world(triangles, {diffuse(0.9)}, Vec3d(1000));
  world.scene = std::make_shared<Scene>(with_shading(*world.scene, Shading::smooth));
  test::set_camera(world, {.eye = {0.1, 0, 0.2}, .fov_degrees = 120}, {32, 32});
  const Film film = test::render(world, path(), {.bounces = 16}, {32, 32}, 8);
  for (int i = 0; i < 32 * 32; ++i) ASSERT_EQ(film.mean(i % 32, i / 32), Vec3f(0));
}

TEST(Path, nothing_leaks_through_the_sharp_edges_of_a_closed_tetrahedron) {
  const Vec3f a(-1, -1, -1), b(3, -0.9f, -1.1f), c(2.8f, 0.1f, -1), d(2.9f, -0.5f, 0.1f);
  Triangles triangles;
  triangles.add(a, b, c);
  triangles.add(a, b, d);
  triangles.add(b, c, d);
  triangles.add(a, c, d);
  World world = test::make_world(triangles, {diffuse(0.95)}, Vec3d(1e9));
  // Close to the sharpest corner, where every path is close to edges.
  const Vec3d to_center = Vec3d(0.25f * (a + b + c + d) - a);
  const Camera camera{.eye = Vec3d(a) + 0.01 * to_center, .target = Vec3d(a), .fov_degrees = 140};
  test::set_camera(world, camera, {128, 128});
  const Film film = test::render(world, path(), {.bounces = 32}, {128, 128}, 20);
  for (int i = 0; i < 128 * 128; ++i) ASSERT_EQ(film.mean(i % 128, i / 128), Vec3f(0));
}

}  // namespace
}  // namespace tracer
