// SPDX-License-Identifier: MIT
#include "tracer/scene/profile.h"

#include <gtest/gtest.h>

#include "tests/support/worlds.h"

namespace tracer {
namespace {

Scene scene_of(double emission) {
  test::Triangles triangles;
  triangles.add_sphere({0, 0, 0}, 1, 1, 0);
  return *test::make_world(triangles, {test::diffuse(0.5, emission)}, Vec3d(1)).scene;
}

TEST(SceneProfile, is_plain_until_a_surface_varies) {
  Scene scene = scene_of(0);
  EXPECT_TRUE(make_profile(scene).is_plain());
  EXPECT_FALSE(make_profile(with_shading(scene, Shading::smooth)).is_plain());
  Mesh colored = *scene.mesh;
  colored.colors.assign(colored.positions.size(), Vec3f(0.5f));
  scene.mesh = std::make_shared<const Mesh>(std::move(colored));
  EXPECT_FALSE(make_profile(scene).is_plain());
}

TEST(SceneProfile, is_plain_only_where_all_is_diffuse_and_opaque) {
  test::Triangles triangles;
  triangles.add_sphere({0, 0, 0}, 1, 1, 0);
  Material metal = test::diffuse(0.5);
  metal.scattering.metallic = 1;
  Material veil = test::diffuse(0.5);
  veil.opacity = 0.5f;
  for (const Material& material : {metal, veil}) {
    const World world = test::make_world(triangles, {material}, Vec3d(1));
    EXPECT_FALSE(make_profile(*world.scene).is_plain());
  }
}

TEST(SceneProfile, what_a_texture_makes_shine_emits) {
  test::Triangles triangles;
  triangles.add_sphere({0, 0, 0}, 1, 1, 0);
  Material screen = test::diffuse(0.5, 1);
  screen.set_map(MapSlot::emission, {.texture = 0});
  const World world = test::make_world(triangles, {screen}, Vec3d(1));
  EXPECT_TRUE(world.scene->lights->empty());
  EXPECT_TRUE(make_profile(*world.scene).has_emissive_triangles);
}

TEST(SceneProfile, whatever_a_scene_has_is_not_listed_as_skipped) {
  const size_t all = skipped_work(make_profile(scene_of(0))).size();
  EXPECT_EQ(skipped_work(make_profile(scene_of(3))).size(), all - 1);
  EXPECT_EQ(skipped_work(make_profile(with_shading(scene_of(0), Shading::smooth))).size(), all - 2);
}

}  // namespace
}  // namespace tracer
