// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tracer/scene/scene.h"

namespace tracer {
namespace {

Scene scene_of(Mesh mesh) {
  Scene scene;
  scene.mesh = std::make_shared<Mesh>(std::move(mesh));
  scene.materials = std::make_shared<std::vector<Material>>(1);
  return scene;
}

/// The unit cube with shared corners; each face's diagonal as chance has it.
Mesh make_cube() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

Vec3f corner_normal(const Scene& scene, uint32_t triangle, int corner) {
  return (*scene.shading_normals)[(*scene.shading_normal_indices)[triangle][corner]];
}

TEST(ShadingNormals, flat_has_none_and_shades_geometrically) {
  const Scene scene =
      with_shading(with_shading(scene_of(make_cube()), Shading::smooth), Shading::flat);
  EXPECT_EQ(scene.shading, Shading::flat);
  EXPECT_EQ(scene.shading_normals, nullptr);
  const Surface surface =
      surface_at(scene, {.t = 1, .u = 0.2, .v = 0.2, .primitive = 0}, {0, 0, 1});
  EXPECT_EQ(surface.shading_normal, Vec3d(0, 0, -1));
}

TEST(ShadingNormals, angles_weigh_so_that_diagonals_do_not_matter) {
  const Mesh cube = make_cube();
  const Scene scene = with_shading(scene_of(cube), Shading::smooth);
  for (uint32_t triangle = 0; triangle < cube.triangle_count(); ++triangle) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3f expected =
          glm::normalize(cube.positions[cube.triangles[triangle][corner]] - Vec3f(0.5f));
      EXPECT_LT(glm::length(corner_normal(scene, triangle, corner) - expected), 2e-7f);
    }
  }
}

TEST(ShadingNormals, the_files_normals_are_taken_without_a_copy) {
  Mesh mesh = make_cube();
  mesh.normals = {{0, 0, 1}};
  mesh.normal_indices.assign(mesh.triangles.size(), Vec3u(0));
  const Scene scene = with_shading(scene_of(mesh), Shading::smooth);
  EXPECT_EQ(scene.shading_normals->data(), scene.mesh->normals.data());
  EXPECT_EQ(corner_normal(scene, 3, 2), Vec3f(0, 0, 1));
}

TEST(ShadingNormals, corners_without_a_normal_get_the_mean_and_the_others_keep_theirs) {
  Mesh mesh = make_cube();
  mesh.normals = {{0, 0, 1}};
  mesh.normal_indices.assign(mesh.triangles.size(), Vec3u(0));
  mesh.normal_indices[4].y = no_index;
  const Scene scene = with_shading(scene_of(mesh), Shading::smooth);
  EXPECT_EQ(corner_normal(scene, 4, 0), Vec3f(0, 0, 1));
  const Vec3f expected = glm::normalize(mesh.positions[1] - Vec3f(0.5f));
  EXPECT_LT(glm::length(corner_normal(scene, 4, 1) - expected), 2e-7f);
}

TEST(ShadingNormals, opposite_triangles_cancel_and_are_shaded_geometrically) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  const Scene scene = with_shading(scene_of(mesh), Shading::smooth);
  const Surface surface =
      surface_at(scene, {.t = 1, .u = 0.2, .v = 0.2, .primitive = 0}, {0, 0, 1});
  EXPECT_EQ(surface.shading_normal, Vec3d(0, 0, -1));
}

TEST(ShadingNormals, a_triangle_without_area_and_an_unused_position_do_no_harm) {
  Mesh mesh = make_cube();
  mesh.positions.emplace_back(9, 9, 9);
  mesh.triangles.emplace_back(0, 0, 7);
  const Scene scene = with_shading(scene_of(mesh), Shading::smooth);
  for (const Vec3f& normal : *scene.shading_normals) EXPECT_TRUE(is_finite(normal));
  EXPECT_LT(glm::length(corner_normal(scene, 0, 0) + glm::normalize(Vec3f(1))), 2e-7f);
}

TEST(ShadingNormals, interpolated_normals_have_unit_length_on_the_side_of_the_ray) {
  const Scene scene = with_shading(scene_of(make_cube()), Shading::smooth);
  const Hit hit{.t = 1, .u = 0.2, .v = 0.5, .primitive = 0};
  const Surface outside = surface_at(scene, hit, {0, 0, 1});
  EXPECT_NEAR(glm::length(outside.shading_normal), 1, 1e-15);
  EXPECT_LT(outside.shading_normal.z, 0);
  EXPECT_EQ(surface_at(scene, hit, {0, 0, -1}).shading_normal, -outside.shading_normal);
}

}  // namespace
}  // namespace tracer
