// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/support/worlds.h"

namespace tracer {
namespace {

TEST(Lights, are_the_emitting_triangles_with_area_by_power) {
  test::Triangles triangles;
  triangles.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0);
  triangles.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
  triangles.add({0, 0, 0}, {2, 0, 0}, {0, 3, 0}, 1);
  triangles.add({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, 1);
  triangles.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2);
  const EmissiveTriangles lights = make_emissive_triangles(
      triangles.mesh, {test::diffuse(1), test::diffuse(1, 1), test::diffuse(1, 3)});
  EXPECT_EQ(lights.triangles, (std::vector<uint32_t>{1, 2, 4}));
  EXPECT_NEAR(lights.probabilities[0], 0.1, 1e-15);
  EXPECT_NEAR(lights.probabilities[1], 0.6, 1e-15);
  EXPECT_NEAR(lights.probabilities[2], 0.3, 1e-15);
  EXPECT_NEAR(lights.cumulative[1], 0.7, 1e-15);
  EXPECT_EQ(lights.cumulative.back(), 1);
}

TEST(Lights, what_a_texture_makes_shine_is_left_to_paths) {
  test::Triangles triangles;
  triangles.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Material material = test::diffuse(1, 1);
  material.set_map(MapSlot::emission, {.texture = 0});
  EXPECT_TRUE(make_emissive_triangles(triangles.mesh, {material}).empty());
}

TEST(Lights, a_scene_that_does_not_emit_has_none) {
  test::Triangles triangles;
  triangles.add_box(Vec3f(0), Vec3f(1));
  EXPECT_TRUE(make_emissive_triangles(triangles.mesh, {test::diffuse(1)}).empty());
}

}  // namespace
}  // namespace tracer
