// SPDX-License-Identifier: MIT
#include "tracer/render/pass_through.h"

#include <gtest/gtest.h>

#include "tests/support/path_strategies.h"
#include "tests/support/worlds.h"

namespace tracer {
namespace {

using test::by_scattering;
using test::path;

constexpr double sky = 3;

Material veil(float opacity) {
  Material material = test::diffuse(0);
  material.opacity = opacity;
  return material;
}

/// Black veils, one behind the other, between the eye and the sky.
World make_veils(int count, float opacity, const Vec3d& radiance = Vec3d(sky)) {
  test::Triangles triangles;
  for (int i = 0; i < count; ++i) {
    const auto z = static_cast<float>(-i);
    triangles.add_quad({-50, -50, z}, {100, 0, 0}, {0, 100, 0});
  }
  World world = test::make_world(triangles, {veil(opacity)}, radiance);
  test::set_camera(world, {.eye = {0, 0, 5}, .target = {0, 0, 0}, .fov_degrees = 20}, {1, 1});
  return world;
}

TEST(PassThrough, veils_let_their_shares_of_camera_rays_pass) {
  for (const int count : {1, 2, 5}) {
    const test::Estimate found =
        test::estimate(make_veils(count, 0.3f), path(), {.bounces = 0}, 20'000);
    EXPECT_NEAR(found.mean, sky * std::pow(0.7, count), 4 * found.standard_error) << count;
  }
  EXPECT_EQ(test::estimate(make_veils(9, 0), path(), {.bounces = 0}, 100).mean, sky);
  EXPECT_EQ(test::estimate(make_veils(1, 1), path(), {.bounces = 0}, 100).mean, 0);
}

TEST(PassThrough, transmittance_is_the_product_of_shares) {
  const World world = make_veils(5, 0.25f);
  const StopFlag never;
  RayCaster rays(*world.accel, never);
  const Ray whole{.origin = {1, 2, 5}, .direction = {0, 0, -1}};
  EXPECT_DOUBLE_EQ(transmittance(*world.scene, rays, whole), std::pow(0.75, 5));
  Ray part = whole;
  part.t_max = 6.5;  // past two of them
  EXPECT_DOUBLE_EQ(transmittance(*world.scene, rays, part), 0.75 * 0.75);
  const World wall = make_veils(2, 1);
  RayCaster to_wall(*wall.accel, never);
  EXPECT_EQ(transmittance(*wall.scene, to_wall, whole), 0);
}

/// A white floor under a lamp with a black veil between.
World make_shaded_floor(float opacity, test::Tracing tracing = test::Tracing::tree) {
  test::Triangles triangles;
  triangles.add_quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, 0);
  triangles.add_quad({-9, 1, -9}, {0, 0, 18}, {18, 0, 0}, 1);
  triangles.add_quad({-1, 3, -1}, {2, 0, 0}, {0, 0, 2}, 2);
  World world = test::make_world(
      triangles, {test::diffuse(0.8), veil(opacity), test::diffuse(0, 5)}, Vec3d(0), tracing);
  test::set_camera(world, {.eye = {0.3, 0.5, 2}, .target = {0, 0, 0}, .fov_degrees = 10}, {1, 1});
  return world;
}

TEST(PassThrough, light_is_found_through_veils_whichever_way_it_is_looked_for) {
  const double open = test::estimate(make_shaded_floor(0), path(), {.bounces = 1}, 20'000).mean;
  const World world = make_shaded_floor(0.4f);
  const test::Estimate both = test::estimate(world, path(), {.bounces = 1}, 20'000);
  EXPECT_NEAR(both.mean, 0.6 * open, 0.02 * open);
  const test::Estimate scattered = test::estimate(world, by_scattering, {.bounces = 1}, 200'000);
  EXPECT_NEAR(scattered.mean, both.mean, 4 * scattered.standard_error);
}

TEST(PassThrough, previews_look_through_veils) {
  const World open = make_shaded_floor(0);
  const World veiled = make_shaded_floor(0.4f);
  const World closed = make_shaded_floor(1);
  // The camera looks under the veil. Beside it, and past the lamp, a probe sees the sky.
  const auto openness = [](const World& world) {
    return test::estimate(world, *find_integrator("ao"), {}, 20'000).mean;
  };
  const double none = openness(closed);
  EXPECT_NEAR(openness(veiled), none + 0.6 * (openness(open) - none), 0.01);
  EXPECT_GT(openness(open), none + 0.5);

  const World veils = make_veils(2, 0.3f);
  const test::Estimate seen = test::estimate(veils, *find_integrator("normals"), {}, 20'000);
  const test::Estimate wall = test::estimate(make_veils(2, 1), *find_integrator("normals"), {}, 1);
  EXPECT_NEAR(seen.mean, (1 - 0.7 * 0.7) * wall.mean, 4 * seen.standard_error);
}

TEST(PassThrough, pictures_have_the_same_bits_with_any_tree_and_when_nothing_is_skipped) {
  const Vec2i size(24, 24);
  const auto picture = [&](test::Tracing tracing, bool skips) {
    World world = make_shaded_floor(0.4f, tracing);
    test::set_camera(world, {.eye = {1, 2, 6}, .target = {0, 1, 0}}, size);
    RenderSettings settings;
    settings.skips = skips;
    return test::render(world, path(), settings, size, 4).image().pixels;
  };
  const auto expected = picture(test::Tracing::tree, true);
  EXPECT_EQ(picture(test::Tracing::brute_force, true), expected);
  EXPECT_EQ(picture(test::Tracing::tree, false), expected);
}

}  // namespace
}  // namespace tracer
