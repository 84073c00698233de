// SPDX-License-Identifier: MIT
// What is left out because a scene does not need it must not be missed.
#include <gtest/gtest.h>

#include "tests/support/instruction_sets.h"
#include "tests/support/worlds.h"

namespace tracer {
namespace {

// Not a whole number of blocks.
constexpr Vec2i size_px(45, 37);

/// A lit ball over a floor, far away in the sky.
World make_far_ball(double emission) {
  test::Triangles triangles;
  triangles.add_sphere({0, 1, 0}, 1, 2, 0);
  triangles.add_quad({-3, 0, -3}, {0, 0, 6}, {6, 0, 0}, 1);
  triangles.add_quad({-1, 4, -1}, {2, 0, 0}, {0, 0, 2}, 2);
  World world = test::make_world(
      triangles, {test::diffuse(0.7), test::diffuse(0.4), test::diffuse(0.5, emission)},
      Vec3d(0.3, 0.5, 0.7));
  test::set_camera(world, {.eye = {9, 12, 40}, .target = {6, 1, 0}}, size_px);
  return world;
}

World make_smooth(World world) {
  world.scene = std::make_shared<const Scene>(with_shading(*world.scene, Shading::smooth));
  return world;
}

std::vector<Vec3f> pixels(const World& world, const Integrator& integrator,
                          const RenderSettings& settings) {
  return test::render(world, integrator, settings, size_px, 3).image().pixels;
}

TEST(Skips, leave_every_bit_of_the_picture_as_it_is_with_every_instruction_set) {
  for_each_instruction_set([&](const std::string& name) {
    const World worlds[] = {test::make_room(size_px), make_far_ball(0), make_far_ball(20),
                            make_smooth(test::make_room(size_px))};
    for (const World& world : worlds) {
      for (const Integrator& integrator : integrators()) {
        for (const int bounces : {0, 1, 2, 9}) {
          EXPECT_EQ(pixels(world, integrator, {.bounces = bounces}),
                    pixels(world, integrator, {.bounces = bounces, .skips = false}))
              << name << ' ' << &world - worlds << ' ' << integrator.name << ' ' << bounces;
        }
      }
    }
  });
}

uint64_t rays_of_a_pass(const World& world, const RenderSettings& settings) {
  Film film(size_px);
  const StopFlag never;
  return render_pass(world, *find_integrator("path"), settings, {0, 1}, film, never).rays;
}

TEST(Skips, trace_nothing_for_pixels_that_cannot_meet_the_model) {
  const World world = make_far_ball(0);
  EXPECT_LT(rays_of_a_pass(world, {.bounces = 0}),
            rays_of_a_pass(world, {.bounces = 0, .skips = false}) / 2);
}

}  // namespace
}  // namespace tracer
