// SPDX-License-Identifier: MIT
#include "app/viewer/viewpoint.h"

#include <optional>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/support/test_meshes.h"

namespace app {
namespace {

using tracer::Camera;
using tracer::Vec3d;

constexpr double aspect = 1.5;

Viewpoint open_ball(const std::optional<tracer::View>& view) {
  Viewpoint viewpoint;
  viewpoint.open(tracer::rough_ball(4, 0.1f, 1), view, aspect);
  return viewpoint;
}

void expect_near(const Camera& a, const Camera& b) {
  EXPECT_LT(length(a.eye - b.eye), 1e-9);
  EXPECT_LT(length(a.target - b.target), 1e-9);
  EXPECT_LT(length(a.up - b.up), 1e-9);
}

/// What a view file of this camera gives back.
tracer::View saved_and_loaded(const Camera& camera) {
  const tracer::TemporaryFolder folder;
  tracer::save_view(folder / "ball.view.json", {camera, std::nullopt, std::nullopt});
  return tracer::load_view(folder / "ball.view.json");
}

TEST(Viewpoint, a_view_saved_from_the_top_keeps_the_world_upright) {
  for (const Axis saved_axis : {Axis::top, Axis::bottom}) {
    Viewpoint saved = open_ball(std::nullopt);
    saved.look_along(saved_axis);
    Viewpoint reopened = open_ball(saved_and_loaded(saved.camera()));
    expect_near(reopened.camera(), saved.camera());
    for (const Axis axis : {Axis::front, Axis::left, Axis::top, Axis::back, Axis::right}) {
      saved.look_along(axis);
      reopened.look_along(axis);
      expect_near(reopened.camera(), saved.camera());
    }
  }
}

TEST(Viewpoint, a_saved_view_says_what_is_up) {
  const Camera camera{.eye = {5, 0, 1}, .target = {0, 0, 0}, .up = {0, 0, 2}, .fov_degrees = 40};
  Viewpoint viewpoint = open_ball(tracer::View{camera, std::nullopt, std::nullopt});
  viewpoint.look_along(Axis::front);
  EXPECT_LT(length(viewpoint.camera().up - Vec3d(0, 0, 1)), 1e-12);
  EXPECT_LT(viewpoint.camera().eye.y, 0);
}

TEST(Viewpoint, a_tilted_world_is_seen_level_from_all_sides) {
  const Vec3d up = normalize(Vec3d(0.3, 1, 0.4));
  const Camera camera{.eye = {5, 0, 1}, .target = {0, 0, 0}, .up = up, .fov_degrees = 40};
  Viewpoint viewpoint = open_ball(tracer::View{camera, std::nullopt, std::nullopt});
  const double distance = length(camera.eye - camera.target);
  for (const Axis axis : {Axis::front, Axis::back, Axis::right, Axis::left}) {
    viewpoint.look_along(axis);
    const Vec3d offset = viewpoint.camera().eye - viewpoint.camera().target;
    EXPECT_NEAR(dot(offset, up), 0, 1e-12);
    EXPECT_NEAR(length(offset), distance, 1e-12);
  }
}

}  // namespace
}  // namespace app
