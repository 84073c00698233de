// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/support/worlds.h"

namespace tracer {
namespace {

/// A unit square in the plane z = 0 whose texture coordinates are its x and y, times `uv_scale`.
Scene make_square(const Material& material, const std::vector<Texture>& textures,
                  const Vec2f& uv_scale = Vec2f(1)) {
  test::Triangles triangles;
  triangles.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  for (const Vec3f& position : triangles.mesh.positions) {
    triangles.mesh.texcoords.push_back(Vec2f(position) * uv_scale);
  }
  triangles.mesh.texcoord_indices = triangles.mesh.triangles;
  Scene scene = *test::make_world(triangles, {material}, Vec3d(1)).scene;
  scene.textures = std::make_shared<std::vector<Texture>>(textures);
  return scene;
}

Texture plain(const Vec3f& color) {
  return make_texture(1, 1, {color});
}

const Hit middle{.t = 1, .u = 0.25, .v = 0.25, .primitive = 0};
const Vec3d down(0, 0, -1);

TEST(SurfaceMaps, each_slot_decides_its_own) {
  Material material;
  material.emission = Vec3f(2);
  material.set_map(MapSlot::emission, {.texture = 0});
  material.set_map(MapSlot::roughness, {.texture = 0, .channel = TexelChannel::green});
  material.set_map(MapSlot::metallic, {.texture = 0, .channel = TexelChannel::blue});
  material.set_map(MapSlot::specular, {.texture = 0, .channel = TexelChannel::red});
  const Surface surface =
      surface_at(make_square(material, {plain({0.25f, 0.5f, 7})}), middle, down);
  EXPECT_EQ(surface.emission, Vec3d(0.5, 1, 14));
  EXPECT_EQ(surface.scattering.roughness, 0.5f);
  EXPECT_EQ(surface.scattering.metallic, 1);
  EXPECT_EQ(surface.scattering.specular, 0.25f);
  EXPECT_EQ(surface.scattering.base_color, Vec3f(0.8f));
}

TEST(SurfaceMaps, scale_offset_base_and_gain_are_applied) {
  Material material;
  const Texture steps = make_texture(4, 1, {Vec3f(0), Vec3f(0.25f), Vec3f(0.5f), Vec3f(1)});
  MaterialMap map{
      .texture = 0, .offset = {0.125f, 0}, .scale = {0.5f, 1}, .base = 0.1f, .gain = 0.5f};
  material.set_map(MapSlot::roughness, map);
  // u = 0.5 looks up 0.375, the middle of the second.
  const Surface surface = surface_at(make_square(material, {steps}), middle, down);
  EXPECT_FLOAT_EQ(surface.scattering.roughness, 0.1f + 0.5f * 0.25f);
}

TEST(SurfaceMaps, wide_footprints_see_the_mean) {
  Material material;
  material.set_map(MapSlot::roughness, {.texture = 0});
  const Texture stripes = make_texture(2, 2, {Vec3f(0), Vec3f(1), Vec3f(0), Vec3f(1)});
  const Scene scene = make_square(material, {stripes});
  const Hit left{.t = 1, .u = 0, .v = 0.25, .primitive = 0};
  const float near = surface_at(scene, left, down).scattering.roughness;
  EXPECT_NE(near, 0.5f);
  // Two texels of half a unit each.
  EXPECT_EQ(surface_at(scene, left, down, 1.0).scattering.roughness, 0.5f);
  EXPECT_EQ(surface_at(scene, left, down, 1e9).scattering.roughness, 0.5f);
}

TEST(SurfaceMaps, normals_lean_along_the_texture_from_both_sides_and_where_it_is_mirrored) {
  Material material;
  material.set_map(MapSlot::normal, {.texture = 0});
  // In floats, 2 t - 1: leaning towards growing u and v.
  const Vec3d leaning = glm::normalize(Vec3d(0.5, 0.25, 0.75));
  const Texture texture = plain({0.75f, 0.625f, 0.875f});
  const auto normal_at = [&](const Vec2f& uv_scale, const Vec3d& direction) {
    return surface_at(make_square(material, {texture}, uv_scale), middle, direction).shading_normal;
  };
  EXPECT_LT(glm::length(normal_at({1, 1}, down) - leaning), 1e-12);
  EXPECT_LT(glm::length(normal_at({3, 3}, down) - leaning), 1e-12);
  EXPECT_LT(glm::length(normal_at({1, 1}, -down) + leaning), 1e-12);
  EXPECT_LT(glm::length(normal_at({-1, 1}, down) - Vec3d(-leaning.x, leaning.y, leaning.z)), 1e-12);
  EXPECT_LT(glm::length(normal_at({1, -1}, down) - Vec3d(leaning.x, -leaning.y, leaning.z)), 1e-12);
  EXPECT_EQ(normal_at({0, 0}, down), Vec3d(0, 0, 1));
}

TEST(SurfaceMaps, strength_scales_the_lean_and_128_is_upright) {
  Material material;
  material.set_map(MapSlot::normal, {.texture = 0});
  material.normal_strength = 0;
  const Texture leaning = plain({0.75f, 0.625f, 0.875f});
  EXPECT_EQ(surface_at(make_square(material, {leaning}), middle, down).shading_normal,
            Vec3d(0, 0, 1));
  material.normal_strength = 1;
  const Texture upright = normals_of_heights(make_texture(1, 1, {Vec3f(0.3f)}));
  const Vec3d normal = surface_at(make_square(material, {upright}), middle, down).shading_normal;
  EXPECT_LT(glm::length(normal - Vec3d(0, 0, 1)), 1e-6);
}

TEST(SurfaceMaps, a_normal_behind_the_surface_is_left_out) {
  Material material;
  material.set_map(MapSlot::normal, {.texture = 0});
  EXPECT_EQ(
      surface_at(make_square(material, {plain({1, 0.5f, 0.25f})}), middle, down).shading_normal,
      Vec3d(0, 0, 1));
}

TEST(SurfaceMaps, opacity_is_the_number_times_alpha_or_luminance) {
  Material material;
  EXPECT_FALSE(summarize({material}).has_alpha);
  material.opacity = 0.5f;
  EXPECT_TRUE(summarize({material}).has_alpha);
  EXPECT_EQ(opacity_at(make_square(material, {}), middle), 0.5);
  material.set_map(MapSlot::opacity, {.texture = 0, .channel = TexelChannel::alpha});
  EXPECT_NEAR(opacity_at(make_square(material, {plain(Vec3f(0.5f))}), middle), 0.25, 1e-7);
  Texture cut_out;
  cut_out.width = cut_out.height = 1;
  cut_out.channel_count = 4;
  cut_out.codes = {255, 255, 255, 51};
  add_levels(cut_out);
  EXPECT_NEAR(opacity_at(make_square(material, {cut_out}), middle), 0.1, 1e-7);
}

TEST(SurfaceMaps, without_texture_coordinates_the_numbers_count) {
  Material material;
  material.opacity = 0.5f;
  material.set_map(MapSlot::roughness, {.texture = 0});
  material.set_map(MapSlot::opacity, {.texture = 0});
  Scene scene = make_square(material, {plain(Vec3f(0.25f))});
  Mesh mesh = *scene.mesh;
  mesh.texcoord_indices.clear();
  scene.mesh = std::make_shared<Mesh>(mesh);
  EXPECT_EQ(surface_at(scene, middle, down).scattering.roughness, 1);
  EXPECT_EQ(opacity_at(scene, middle), 0.5);
}

}  // namespace
}  // namespace tracer
