// SPDX-License-Identifier: MIT
#include "app/viewer/orbit.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace app {
namespace {

using tracer::Camera;
using tracer::Vec2d;
using tracer::Vec3d;

constexpr Vec3d y_up{0, 1, 0};
constexpr double right_angle = std::numbers::pi / 2;

Camera front_camera() {
  return {.eye = {0, 0, 5}, .target = {0, 0, 0}, .up = y_up, .fov_degrees = 40};
}

double distance_of(const Camera& camera) {
  return length(camera.eye - camera.target);
}

void expect_near(const Vec3d& a, const Vec3d& b) {
  EXPECT_LT(length(a - b), 1e-12) << a.x << ' ' << a.y << ' ' << a.z << " instead of " << b.x << ' '
                                  << b.y << ' ' << b.z;
}

/// Where a point appears, in units of half the picture's height, y up.
Vec2d project(const Camera& camera, const Vec3d& point) {
  const Vec3d forward = normalize(camera.target - camera.eye);
  const Vec3d right = normalize(cross(forward, camera.up));
  const Vec3d up = cross(right, forward);
  const Vec3d offset = point - camera.eye;
  const double half_height = std::tan(camera.fov_degrees * std::numbers::pi / 360);
  return Vec2d(dot(offset, right), dot(offset, up)) / (dot(offset, forward) * half_height);
}

TEST(Orbit, keeps_the_target_and_the_distance) {
  Camera camera = front_camera();
  for (int i = 0; i < 1000; ++i) camera = orbit(camera, y_up, {0.37, 0.11 * std::sin(i)});
  expect_near(camera.target, {0, 0, 0});
  EXPECT_NEAR(distance_of(camera), 5, 1e-9);
}

TEST(Orbit, what_is_in_front_follows_the_drag) {
  const Vec3d nearest{0, 0, 1};
  EXPECT_GT(project(orbit(front_camera(), y_up, {0.1, 0}), nearest).x, 0);
  EXPECT_LT(project(orbit(front_camera(), y_up, {0, 0.1}), nearest).y, 0);
}

TEST(Orbit, a_whole_turn_comes_back) {
  Camera camera = orbit(front_camera(), y_up, {0.3, 0.4});
  const Camera start = camera;
  for (int i = 0; i < 8; ++i) camera = orbit(camera, y_up, {right_angle / 2, 0});
  expect_near(camera.eye, start.eye);
}

TEST(Orbit, ends_at_the_poles_and_keeps_its_heading_there) {
  const Camera start = orbit(front_camera(), y_up, {0.7, 0});
  const Camera pole = orbit(start, y_up, {0, 9});
  expect_near(pole.eye, {0, 5, 0});
  const Camera back = orbit(pole, y_up, {0, -right_angle});
  expect_near(back.eye, start.eye);
  const Camera nadir = orbit(start, y_up, {0, -9});
  expect_near(nadir.eye, {0, -5, 0});
  expect_near(orbit(nadir, y_up, {0, right_angle}).eye, start.eye);
}

TEST(Orbit, turns_at_a_pole) {
  const Camera pole = orbit(front_camera(), y_up, {0, 9});
  const Camera turned = orbit(orbit(pole, y_up, {right_angle, 0}), y_up, {0, -right_angle});
  expect_near(turned.eye, {-5, 0, 0});
}

TEST(Orbit, a_camera_in_its_target_stays_finite) {
  const Camera camera{.eye = {1, 2, 3}, .target = {1, 2, 3}, .up = y_up, .fov_degrees = 40};
  EXPECT_TRUE(tracer::is_finite(orbit(camera, y_up, {0.1, 0.1}).eye));
  EXPECT_EQ(dolly(camera, 0.5, {3, 4}, 100, 0.1), camera);
}

TEST(Pan, what_lies_at_the_target_follows_the_drag_pixel_for_pixel) {
  const Camera start = orbit(front_camera(), y_up, {0.5, 0.3});
  const Camera panned = pan(start, {30, -20}, 200);
  const Vec2d moved = project(panned, start.target);
  EXPECT_NEAR(moved.x, 30 / 100.0, 1e-12);
  EXPECT_NEAR(moved.y, 20 / 100.0, 1e-12);
  EXPECT_NEAR(distance_of(panned), 5, 1e-12);
}

TEST(Dolly, what_lies_under_the_cursor_stays_there) {
  const Camera start = orbit(front_camera(), y_up, {0.5, 0.3});
  const Vec3d forward = normalize(start.target - start.eye);
  const Vec3d right = normalize(cross(forward, start.up));
  const Vec3d point = start.target + 0.4 * right + 0.2 * cross(right, forward);
  const Vec2d before = project(start, point);
  const Camera nearer = dolly(start, 0.5, Vec2d(before.x, -before.y) * 150.0, 300, 1e-3);
  EXPECT_NEAR(distance_of(nearer), 2.5, 1e-12);
  EXPECT_NEAR(project(nearer, point).x, before.x, 1e-12);
  EXPECT_NEAR(project(nearer, point).y, before.y, 1e-12);
}

TEST(Dolly, ends_at_the_least_distance_and_comes_back) {
  Camera camera = front_camera();
  for (int i = 0; i < 100; ++i) camera = dolly(camera, 0.5, {0, 0}, 300, 0.01);
  EXPECT_NEAR(distance_of(camera), 0.01, 1e-12);
  EXPECT_GT(distance_of(dolly(camera, 2, {0, 0}, 300, 0.01)), 0.015);
}

TEST(LookAlong, axis_views_are_those_of_a_y_up_and_of_a_z_up_world) {
  const Vec3d z_up{0, 0, 1};
  const Camera camera = orbit(front_camera(), y_up, {0.5, 0.3});
  expect_near(look_along(camera, Axis::front, y_up).eye, {0, 0, 5});
  expect_near(look_along(camera, Axis::right, y_up).eye, {5, 0, 0});
  expect_near(look_along(camera, Axis::top, y_up).eye, {0, 5, 0});
  expect_near(look_along(camera, Axis::back, y_up).eye, {0, 0, -5});
  expect_near(look_along(camera, Axis::front, z_up).eye, {0, -5, 0});
  expect_near(look_along(camera, Axis::left, z_up).eye, {-5, 0, 0});
  expect_near(look_along(camera, Axis::bottom, z_up).eye, {0, 0, -5});
}

TEST(LookAlong, x_points_to_the_right_in_the_front_and_top_views) {
  for (const Vec3d& up : {y_up, Vec3d(0, 0, 1)}) {
    for (const Axis axis : {Axis::front, Axis::top}) {
      EXPECT_GT(project(look_along(front_camera(), axis, up), {1, 0, 0}).x, 0.1);
    }
  }
}

}  // namespace
}  // namespace app
