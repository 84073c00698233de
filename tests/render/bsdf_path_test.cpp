// SPDX-License-Identifier: MIT
// Whole paths over surfaces that reflect, are coated, or let light through.
#include <gtest/gtest.h>

#include "tests/support/path_strategies.h"
#include "tests/support/worlds.h"

namespace tracer {
namespace {

using test::by_lights;
using test::by_scattering;
using test::estimate;
using test::Estimate;
using test::path;
using test::Triangles;

Material material_of(const Principled& p, double emission = 0) {
  Material material;
  material.scattering = p;
  material.emission = Vec3f(static_cast<float>(emission));
  return material;
}

constexpr Vec3f white(1);
const Principled plain{.base_color = Vec3f(0.5f)};

struct Named {
  const char* name;
  Principled p;
};
const Named finishes[] = {
    {"rough metal", {.base_color = Vec3f(0.9f), .metallic = 1, .roughness = 0.5f}},
    {"polished metal", {.base_color = Vec3f(0.9f), .metallic = 1, .roughness = 0.2f}},
    {"varnish", {.base_color = Vec3f(0.6f), .roughness = 0.4f, .specular = 0.5f}},
    {"mirror", {.base_color = Vec3f(0.8f), .metallic = 1, .roughness = 0}},
    {"coat", {.base_color = Vec3f(0.6f), .sheen = 0.5f, .coat = 1, .coat_roughness = 0.3f}},
    {"frosted glass", {.base_color = Vec3f(0.9f), .roughness = 0.5f, .transmission = 1}},
    {"half glass",
     {.base_color = Vec3f(0.8f), .roughness = 0.4f, .specular = 0.5f, .transmission = 0.5f}},
    {"glass", {.base_color = Vec3f(0.9f), .roughness = 0, .transmission = 1}},
};

/// A ball of the material over a floor, lit by a quad; the camera looks at the ball's lit side.
World lit_ball(const Principled& p) {
  Triangles triangles;
  triangles.add_quad({-4, -1, -4}, {0, 0, 8}, {8, 0, 0}, 0);
  triangles.add_sphere({0, 0, 0}, 0.8, 3, 1);
  triangles.add_quad({-1, 2.5f, -1}, {2, 0, 0}, {0, 0, 2}, 2);
  World world = test::make_world(
      triangles, {material_of(plain), material_of(p), material_of(plain, 3)}, Vec3d(0.1));
  test::set_camera(world, {.eye = {0.5, 1.5, 4}, .target = {0, 0.1, 0}, .fov_degrees = 18}, {1, 1});
  return world;
}

TEST(BsdfPath, all_ways_of_finding_lights_agree_on_every_finish) {
  for (const auto& [name, p] : finishes) {
    const World world = lit_ball(p);
    const RenderSettings settings{.bounces = 6};
    const Estimate combined = estimate(world, path(), settings, 60'000);
    EXPECT_GT(combined.mean, 0.05) << name;
    for (const Integrator& integrator : {by_lights, by_scattering}) {
      const Estimate other = estimate(world, integrator, settings, 60'000);
      // Welch's test.
      EXPECT_NEAR(combined.mean, other.mean,
                  4 * std::hypot(combined.standard_error, other.standard_error))
          << name;
    }
  }
}

TEST(BsdfPath, both_pdfs_together_have_less_noise_than_either_alone) {
  const World world = lit_ball({.base_color = Vec3f(0.9f), .metallic = 1, .roughness = 0.35f});
  const double combined = estimate(world, path(), {.bounces = 1}, 20'000).standard_error;
  EXPECT_LT(combined, 0.7 * estimate(world, by_lights, {.bounces = 1}, 20'000).standard_error);
  EXPECT_LT(combined, 1.1 * estimate(world, by_scattering, {.bounces = 1}, 20'000).standard_error);
}

/// A white body under a white sky: of what cannot be seen, how far the mean of samples is from 1.
Estimate furnace_ball(const Principled& p) {
  Triangles triangles;
  triangles.add_sphere({0, 0, 0}, 1, 4, 0);
  World world = test::make_world(triangles, {material_of(p)}, Vec3d(1));
  test::set_camera(world, {.eye = {0, 0, 4}, .target = {0, 0, 0}, .fov_degrees = 28}, {1, 1});
  return estimate(world, path(), {.bounces = 64}, 40'000);
}

TEST(BsdfPathFurnace, a_white_ball_of_any_finish_under_a_white_sky_cannot_be_seen) {
  for (auto [name, p] : finishes) {
    p.base_color = white;
    const Estimate found = furnace_ball(p);
    // Coats over layers that are not diffuse lose a little; rough glass is tabulated to 0.5 %.
    const double slack = p.transmission > 0 ? 0.01 : p.coat > 0 ? 0.005 : 5e-4;
    EXPECT_NEAR(found.mean, 1, 4 * found.standard_error + slack) << name;
  }
}

TEST(BsdfPathFurnace, a_ball_of_smooth_clear_glass_is_invisible_in_every_sample) {
  Triangles triangles;
  triangles.add_sphere({0, 0, 0}, 1, 4, 0);
  World world = test::make_world(
      triangles, {material_of({.base_color = white, .roughness = 0, .transmission = 1})}, Vec3d(1));
  test::set_camera(world, {.eye = {0, 0, 4}, .target = {0, 0, 0}}, {32, 32});
  const Film film = test::render(world, path(), {.bounces = 1000}, {32, 32}, 16);
  int black = 0;
  for (int i = 0; i < 32 * 32; ++i) {
    const float value = film.mean(i % 32, i / 32).x;
    EXPECT_LT(value, 1 + 1e-5f);
    black += value < 1 - 1e-5f;
  }
  // Those that total reflection holds inside for 64 scatterings.
  EXPECT_LE(black, 2);
}

TEST(BsdfPathFurnace, a_closed_emitting_box_of_white_walls_has_as_many_parts_as_segments) {
  for (auto [name, p] : finishes) {
    if (p.transmission > 0) continue;  // light would leave the box
    p.base_color = white;
    Triangles triangles;
    triangles.add_box({-1, -2, -1.5f}, {1, 1, 2});
    World world = test::make_world(triangles, {material_of(p, 1)}, Vec3d(0));
    test::set_camera(world, {.eye = {0.3, 0.2, 0.1}, .target = {-1, 0.5, -0.4}, .fov_degrees = 100},
                     {1, 1});
    for (const int bounces : {0, 1, 2, 3, 6, 12}) {
      const Estimate found = estimate(world, path(), {.bounces = bounces}, 10'000);
      const double loss = p.coat > 0 ? 0.005 * bounces * (bounces + 1) / 2 : 2e-4 * bounces;
      EXPECT_NEAR(found.mean, bounces + 1, 4 * found.standard_error + loss) << name << bounces;
    }
  }
}

TEST(BsdfPath, a_mirror_shows_the_light_it_mirrors_in_every_sample) {
  Triangles triangles;
  triangles.add_quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, 0);
  triangles.add_quad({-9, 3, -9}, {18, 0, 0}, {0, 0, 18}, 1);
  World world =
      test::make_world(triangles,
                       {material_of({.base_color = Vec3f(0.5f), .metallic = 1, .roughness = 0}),
                        material_of({.base_color = Vec3f(0)}, 7)},
                       Vec3d(0));
  test::set_camera(world, {.eye = {0, 1, 0.1}, .target = {0, 0, 0}, .fov_degrees = 10}, {1, 1});
  const Estimate found = estimate(world, path(), {.bounces = 1}, 200);
  EXPECT_NEAR(found.mean, 3.5, 0.01);  // half of it, and a hair more by Schlick
  EXPECT_LT(found.standard_error, 1e-4);
}

TEST(BsdfPath, light_falls_through_a_frosted_pane_onto_what_lies_behind) {
  // The lamp is seen by the floor only through the pane.
  const auto floor_seen = [](const Principled& pane) {
    Triangles triangles;
    triangles.add_quad({-9, -1, -9}, {0, 0, 18}, {18, 0, 0}, 0);
    triangles.add_box({-5, 0, -5}, {5, 0.1f, 5}, 1);
    triangles.add_quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, 2);
    World world = test::make_world(
        triangles, {material_of(plain), material_of(pane), material_of(plain, 10)}, Vec3d(0));
    test::set_camera(world, {.eye = {6, -0.5, 0}, .target = {0, -1, 0}, .fov_degrees = 5}, {1, 1});
    return estimate(world, path(), {.bounces = 8}, 20'000).mean;
  };
  EXPECT_GT(floor_seen({.base_color = white, .roughness = 0.6f, .transmission = 1}), 0.1);
  // What goes around it.
  EXPECT_LT(floor_seen({.base_color = white, .roughness = 0.6f}), 1e-3);
}

TEST(BsdfPath, smooth_normals_leave_no_black_edges_on_a_coarse_metal_ball) {
  Triangles triangles;
  triangles.add_sphere({0, 0, 0}, 1, 2, 0);
  World world = test::make_world(
      triangles, {material_of({.base_color = white, .metallic = 1, .roughness = 0.1f})}, Vec3d(1));
  world.scene = std::make_shared<Scene>(with_shading(*world.scene, Shading::smooth));
  test::set_camera(world, {.eye = {0, 0, 4}, .target = {0, 0, 0}, .fov_degrees = 32}, {64, 64});
  const Film film = test::render(world, path(), {.bounces = 16}, {64, 64}, 64);
  for (int i = 0; i < 64 * 64; ++i) EXPECT_GT(film.mean(i % 64, i / 64).x, 0.6f) << i;
}

TEST(BsdfPath, kernels_without_a_feature_have_the_bits_of_those_with_it) {
  constexpr Vec2i size_px(19, 13);
  for (const auto& [name, p] : finishes) {
    World world = lit_ball(p);
    test::set_camera(world, {.eye = {0.5, 1.5, 4}, .target = {0, 0.1, 0}}, size_px);
    const auto pixels = [&](const RenderSettings& settings) {
      return test::render(world, path(), settings, size_px, 4).image().pixels;
    };
    EXPECT_EQ(pixels({}), pixels({.skips = false})) << name;
  }
}

}  // namespace
}  // namespace tracer
