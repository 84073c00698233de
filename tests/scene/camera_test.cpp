// SPDX-License-Identifier: MIT
#include "tracer/scene/camera.h"

#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace tracer {
namespace {

using Vec3l = glm::tvec3<long double>;

constexpr double half_ulp = 0x1p-24;

Box box_of(const Vec3f& min, const Vec3f& max) {
  Box box;
  box.extend(min);
  box.extend(max);
  return box;
}

/// Where a world point appears, in halves of the picture: [-1, 1] is inside.
Vec2d picture_point(const Camera& camera, double aspect, const Vec3d& world_point) {
  const Vec3d forward = glm::normalize(camera.target - camera.eye);
  const Vec3d right = glm::normalize(glm::cross(forward, camera.up));
  const Vec3d up = glm::cross(right, forward);
  const Vec3d to_point = world_point - camera.eye;
  const double half_height =
      glm::dot(to_point, forward) * std::tan(camera.fov_degrees / 360 * std::numbers::pi);
  if (half_height <= 0) return Vec2d(std::numeric_limits<double>::infinity());
  return {glm::dot(to_point, right) / (half_height * aspect), glm::dot(to_point, up) / half_height};
}

/// The largest coordinate at which a corner of the box appears.
double largest_picture_coordinate(const Camera& camera, double aspect, const Box& box,
                                  const Vec3d& origin) {
  double largest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d point(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                      corner & 4 ? box.max.z : box.min.z);
    const Vec2d seen = picture_point(camera, aspect, origin + point);
    largest = std::max({largest, std::abs(seen.x), std::abs(seen.y)});
  }
  return largest;
}

TEST(Camera, pixel_rays_agree_with_long_double_within_two_roundings) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 100'000; ++i) {
    const Camera camera{.eye = {uniform(random), uniform(random), uniform(random)},
                        .target = {uniform(random), uniform(random), uniform(random)},
                        .fov_degrees = 90 + 89 * uniform(random)};
    const Vec2i size(1 + static_cast<int>(random() % 16384),
                     1 + static_cast<int>(random() % 16384));
    const Vec2d point(size.x * (0.5 + 0.5 * uniform(random)),
                      size.y * (0.5 + 0.5 * uniform(random)));
    const Ray ray = camera_ray(make_camera_frame(camera, size, Vec3d(0)), point);

    const Vec3l forward = glm::normalize(Vec3l(camera.target) - Vec3l(camera.eye));
    const Vec3l right = glm::normalize(glm::cross(forward, Vec3l(camera.up)));
    const Vec3l up = glm::cross(right, forward);
    const long double step =
        2 * std::tan(camera.fov_degrees / 360 * std::numbers::pi_v<long double>) / size.y;
    const Vec3l expected = glm::normalize(forward + (point.x - size.x / 2.0L) * step * right -
                                          (point.y - size.y / 2.0L) * step * up);
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_NEAR(ray.direction[axis], static_cast<double>(expected[axis]), 2 * half_ulp);
    }
    ASSERT_NEAR(glm::length(Vec3d(ray.direction)), 1, 2 * half_ulp);
  }
}

TEST(Camera, neighbouring_pixels_of_16k_pictures_have_different_rays) {
  const Vec2i size(16384, 16384);
  const CameraFrame frame = make_camera_frame({.eye = {1, 2, 3}}, size, Vec3d(0));
  for (int y = 0; y < size.y; y += 61) {
    for (int x = 0; x + 1 < size.x; x += 61) {
      const Vec3f here = camera_ray(frame, {x + 0.5, y + 0.5}).direction;
      ASSERT_NE(here, camera_ray(frame, {x + 1.5, y + 0.5}).direction) << x << ' ' << y;
    }
  }
}

TEST(Camera, far_from_the_world_origin_it_sees_the_same) {
  const Vec3d offset(1048576.0, -2097152.0, 524288.0);
  const Camera near{.eye = {1.5, 2.25, -3.125}, .target = {0.5, 0.25, 0.125}};
  const Camera far{.eye = near.eye + offset, .target = near.target + offset};
  const CameraFrame a = make_camera_frame(near, {640, 480}, Vec3d(0));
  const CameraFrame b = make_camera_frame(far, {640, 480}, offset);
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.forward, b.forward);
  EXPECT_EQ(camera_ray(a, {3, 4}).direction, camera_ray(b, {3, 4}).direction);
}

TEST(Camera, every_fov_and_shape_of_picture_gives_finite_unit_rays) {
  for (const double fov : {1e-6, 1.0, 179.9, 1e-30, 179.99999999}) {
    for (const Vec2i size : {Vec2i(1, 1), Vec2i(1, 65535), Vec2i(65535, 1), Vec2i(65535, 65535)}) {
      const CameraFrame frame = make_camera_frame({.fov_degrees = fov}, size, Vec3d(0));
      for (const Vec2d& part : {Vec2d(0, 0), Vec2d(1, 0), Vec2d(0.5, 0.5), Vec2d(1, 1)}) {
        const Vec3f direction = camera_ray(frame, part * Vec2d(size)).direction;
        ASSERT_NEAR(glm::length(Vec3d(direction)), 1, 2 * half_ulp) << fov;
      }
    }
  }
}

TEST(Camera, up_along_the_view_or_without_length_is_mended) {
  for (const Vec3d& view : {Vec3d(0, 1, 0), Vec3d(0, -1, 0), Vec3d(1, 0, 0), Vec3d(1, 2, 3)}) {
    for (const Vec3d& up : {view, -3.0 * view, Vec3d(0), Vec3d(NAN, 0, 0), 1e300 * view}) {
      const CameraFrame frame =
          make_camera_frame({.eye = Vec3d(0), .target = view, .up = up}, {2, 2}, Vec3d(0));
      EXPECT_NEAR(glm::dot(frame.right_step, frame.forward), 0, 1e-15);
      EXPECT_NEAR(glm::dot(frame.right_step, frame.down_step), 0, 1e-15);
      EXPECT_GT(glm::length(frame.right_step), 0.3);
    }
  }
}

TEST(Camera, a_step_right_and_a_step_down_are_those_of_the_picture) {
  const CameraFrame frame = make_camera_frame({.eye = {0, 0, 5}}, {4, 2}, Vec3d(0));
  EXPECT_GT(frame.right_step.x, 0);
  EXPECT_LT(frame.down_step.y, 0);
  EXPECT_LT(camera_ray(frame, {0, 0}).direction.x, 0);
  EXPECT_GT(camera_ray(frame, {0, 0}).direction.y, 0);
}

TEST(FrameBox, shows_every_box_whole_with_a_margin_in_every_window) {
  const Box boxes[] = {box_of({-1, -2, -3}, {1, 2, 3}),
                       box_of({-1e-20f, -1e-20f, -1e-20f}, {1e-20f, 2e-20f, 1e-20f}),
                       box_of({-1e15f, -1e12f, -1e15f}, {1e15f, 1e12f, 1e15f}),
                       box_of({0, -100, 0}, {0, 100, 0}),
                       box_of({-50, 0, -50}, {50, 0, 50}),
                       box_of({-1e-3f, -1e-3f, -1e3f}, {1e-3f, 1e-3f, 1e3f})};
  const Vec3d views[] = {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}, {-0.6, -0.5, -1}, {1, 1, 1}};
  for (const Box& box : boxes) {
    for (const Vec3d& view : views) {
      for (const double aspect : {0.02, 0.5, 1.0, 16.0 / 9, 50.0}) {
        for (const double fov : {5.0, 39.6, 120.0}) {
          const Vec3d up = view.x == 0 && view.z == 0 ? Vec3d(0, 0, -1) : Vec3d(0, 1, 0);
          const Camera camera = frame_box(box, Vec3d(0), view, up, fov, aspect);
          ASSERT_LE(largest_picture_coordinate(camera, aspect, box, Vec3d(0)), 0.95 + 1e-9);
        }
      }
    }
  }
}

TEST(FrameBox, fills_the_picture_on_the_tighter_sides) {
  const Box box = box_of({-1, -2, -3}, {1, 2, 3});
  for (const double aspect : {0.2, 1.0, 5.0}) {
    const Camera camera = frame_box(box, Vec3d(0), {-1, -1, -1}, {0, 1, 0}, 39.6, aspect);
    EXPECT_NEAR(largest_picture_coordinate(camera, aspect, box, Vec3d(0)), 0.95, 1e-9);
  }
}

TEST(FrameBox, a_point_and_an_empty_box_are_seen_from_a_finite_distance) {
  for (const Box& box : {box_of({1, 2, 3}, {1, 2, 3}), Box{}}) {
    const Camera camera = frame_box(box, {1e6, 0, 0}, {0, 0, -1}, {0, 1, 0}, 39.6, 1);
    EXPECT_TRUE(is_finite(camera.eye));
    EXPECT_NE(camera.eye, camera.target);
  }
}

TEST(DefaultCamera, survey_coordinates_do_not_move_the_view) {
  const Box box = box_of({-100, -80, -4}, {100, 80, 4});
  const Vec3d origin(4194304.0, 5242880.0, 128.0);
  const Camera here = default_camera(box, Vec3d(0), 1.5);
  const Camera there = default_camera(box, origin, 1.5);
  EXPECT_NEAR(glm::length(there.eye - origin - here.eye), 0, 1e-8);
  EXPECT_LE(largest_picture_coordinate(there, 1.5, box, origin), 0.95 + 1e-9);
}

TEST(DefaultCamera, flat_terrain_does_not_open_edge_on) {
  const Box terrain_y = box_of({-100, -1, -100}, {100, 1, 100});
  const Box terrain_z = box_of({-100, -100, -1}, {100, 100, 1});
  for (const auto& [box, up] : {std::pair(terrain_y, Vec3d(0, 1, 0)), {terrain_z, {0, 0, 1}}}) {
    EXPECT_EQ(guess_up(box), up);
    const Camera camera = default_camera(box, Vec3d(0), 1.5);
    EXPECT_EQ(camera.up, up);
    // The sine of the view's elevation above the terrain: at least 35 degrees.
    EXPECT_GT(glm::dot(glm::normalize(camera.eye - camera.target), up), 0.57);
  }
}

TEST(DefaultCamera, what_stands_in_y_is_seen_from_the_front_right_and_above) {
  const Box cow = box_of({-5, -3, -1.7f}, {5, 3, 1.7f});
  EXPECT_EQ(guess_up(cow), Vec3d(0, 1, 0));
  const Camera camera = default_camera(cow, Vec3d(0), 1.5);
  const Vec3d towards_eye = glm::normalize(camera.eye - camera.target);
  EXPECT_GT(towards_eye.z, towards_eye.x);
  EXPECT_GT(towards_eye.x, 0.2);
  EXPECT_GT(towards_eye.y, 0.2);
}

TEST(Camera, never_says_that_a_block_of_pixels_cannot_meet_what_one_of_its_rays_meets) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Vec3d(uniform(random), uniform(random), uniform(random)); };
  int empty_count = 0, met_count = 0;
  for (int i = 0; i < 20000; ++i) {
    const double size = std::exp2(4 * uniform(random) - 3);
    const Vec3d near_target = point();
    const Box box = box_of(Vec3f(near_target), Vec3f(near_target + size * point()));
    const CameraFrame frame = make_camera_frame({.eye = 3.0 * point(),
                                                 .target = near_target + 0.3 * point(),
                                                 .fov_degrees = 60 + 59 * uniform(random)},
                                                {64, 48}, Vec3d(0));
    const Vec2d first(8 * std::floor(4 + 4 * uniform(random)),
                      8 * std::floor(3 + 3 * uniform(random)));
    const bool can = can_meet(frame, first, first + Vec2d(8), box);
    empty_count += !can;
    for (int k = 0; k < 20; ++k) {
      const Ray ray =
          camera_ray(frame, first + 4.0 * Vec2d(1 + uniform(random), 1 + uniform(random)));
      double t_min = 0, t_max = std::numeric_limits<double>::infinity();
      for (int axis = 0; axis < 3; ++axis) {
        const double a =
            (static_cast<double>(box.min[axis]) - ray.origin[axis]) / ray.direction[axis];
        const double b =
            (static_cast<double>(box.max[axis]) - ray.origin[axis]) / ray.direction[axis];
        t_min = std::max(t_min, std::min(a, b));
        t_max = std::min(t_max, std::max(a, b));
      }
      if (t_min > t_max) continue;
      ++met_count;
      ASSERT_TRUE(can) << i;
    }
  }
  EXPECT_GT(empty_count, 10000);
  EXPECT_GT(met_count, 5000);
}

}  // namespace
}  // namespace tracer
