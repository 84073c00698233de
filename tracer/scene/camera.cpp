// SPDX-License-Identifier: MIT
#include "tracer/scene/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tracer/base/directions.h"
#include "tracer/base/trigonometry.h"

namespace tracer {
namespace {

constexpr double min_fov_degrees = 1e-6;
constexpr double max_fov_degrees = 179.9;
// Part of the picture that a framed box fills: some 5 % stay free on the tighter sides.
constexpr double framed_part = 0.95;
// What is this much flatter than it is wide is seen from further above.
constexpr double flat_ratio = 0.2;

struct ViewAxes {
  Vec3d right;
  Vec3d up;
  Vec3d forward;
};

/// The world axis that is least along `direction`.
Vec3d least_axis(const Vec3d& direction) {
  const Vec3d size = glm::abs(direction);
  if (size.y <= size.x && size.y <= size.z) return {0, 1, 0};
  return size.x <= size.z ? Vec3d(1, 0, 0) : Vec3d(0, 0, 1);
}

ViewAxes view_axes(const Vec3d& view_direction, const Vec3d& up) {
  const Vec3d forward = unit_or(view_direction, {0, 0, -1});
  Vec3d right = glm::cross(forward, unit_or(up, {0, 1, 0}));
  // Closer to parallel than this, rounding decides where right is.
  constexpr double parallel = 0x1p-40;
  if (max_abs(right) < parallel) right = glm::cross(forward, least_axis(forward));
  right = glm::normalize(right);
  return {right, glm::cross(right, forward), forward};
}

double clamped_fov(double fov_degrees) {
  return std::clamp(fov_degrees, min_fov_degrees, max_fov_degrees);
}

bool is_flat(double height, double width, double depth) {
  return height < flat_ratio * std::min(width, depth);
}

}  // namespace

CameraFrame make_camera_frame(const Camera& camera, Vec2i size_px, const Vec3d& mesh_origin) {
  const ViewAxes axes = view_axes(camera.target - camera.eye, camera.up);
  const double step = 2 * tan_half_degrees(clamped_fov(camera.fov_degrees)) / size_px.y;
  return {.origin = Vec3f(camera.eye - mesh_origin),
          .forward = axes.forward,
          .right_step = step * axes.right,
          .down_step = -step * axes.up,
          .center_px = 0.5 * Vec2d(size_px)};
}

Ray camera_ray(const CameraFrame& frame, const Vec2d& image_point_px) {
  const Vec2d offset = image_point_px - frame.center_px;
  const Vec3d direction = frame.forward + offset.x * frame.right_step + offset.y * frame.down_step;
  return {.origin = frame.origin, .direction = Vec3f(glm::normalize(direction))};
}

bool can_meet(const CameraFrame& frame, const Vec2d& first_px, const Vec2d& end_px,
              const Box& bounds) {
  const auto direction = [&](double x, double y) {
    const Vec2d offset = Vec2d(x, y) - frame.center_px;
    return frame.forward + offset.x * frame.right_step + offset.y * frame.down_step;
  };
  const std::array around{direction(first_px.x, first_px.y), direction(end_px.x, first_px.y),
                          direction(end_px.x, end_px.y), direction(first_px.x, end_px.y)};
  for (size_t side = 0; side < 4; ++side) {
    const Vec3d outward = glm::cross(around[(side + 1) % 4], around[side]);
    double nearest = std::numeric_limits<double>::infinity();
    double farthest_square = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3d to_corner = Vec3d((corner & 1) == 0 ? bounds.min.x : bounds.max.x,
                                    (corner & 2) == 0 ? bounds.min.y : bounds.max.y,
                                    (corner & 4) == 0 ? bounds.min.z : bounds.max.z) -
                              Vec3d(frame.origin);
      nearest = std::min(nearest, glm::dot(outward, to_corner));
      farthest_square = std::max(farthest_square, glm::dot(to_corner, to_corner));
    }
    // Rounding a ray's direction to float turns it by less than 2^-23.
    const double turned = 0x1p-20 * std::sqrt(farthest_square * glm::dot(outward, outward));
    if (nearest > turned) return false;
  }
  return true;
}

Camera frame_box(const Box& bounds, const Vec3d& mesh_origin, const Vec3d& view_direction,
                 const Vec3d& up, double fov_degrees, double aspect) {
  const ViewAxes axes = view_axes(view_direction, up);
  const double tangent_y = framed_part * tan_half_degrees(clamped_fov(fov_degrees));
  const double tangent_x = tangent_y * aspect;
  const Vec3d center = 0.5 * (Vec3d(bounds.min) + Vec3d(bounds.max));
  const Vec3d half = bounds.is_empty() ? Vec3d(0) : 0.5 * bounds.extent();
  const double radius = glm::length(half);

  // The eye stays out of the box; what has no size at all is seen from distance 1.
  double distance = radius > 0 ? radius / framed_part : 1;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d point = half * Vec3d(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const double depth = glm::dot(point, axes.forward);
    const double distance_x = std::abs(glm::dot(point, axes.right)) / tangent_x - depth;
    const double distance_y = std::abs(glm::dot(point, axes.up)) / tangent_y - depth;
    distance = std::max({distance, distance_x, distance_y});
  }
  const Vec3d target = mesh_origin + (bounds.is_empty() ? Vec3d(0) : center);
  return {.eye = target - distance * axes.forward,
          .target = target,
          .up = up,
          .fov_degrees = fov_degrees};
}

Vec3d guess_up(const Box& bounds) {
  const Vec3d size = bounds.extent();
  return is_flat(size.z, size.x, size.y) ? Vec3d(0, 0, 1) : Vec3d(0, 1, 0);
}

Camera default_camera(const Box& bounds, const Vec3d& mesh_origin, double aspect) {
  const Vec3d up = guess_up(bounds);
  const Vec3d size = bounds.extent();
  const bool is_z_up = up.z > 0;
  const double height = is_z_up ? size.z : size.y;
  const double depth = is_z_up ? size.y : size.z;
  // 24 degrees above the horizon, 40 for what is flat; 31 degrees from the front to the right.
  const double rise = is_flat(height, size.x, depth) ? 0.98 : 0.52;
  const Vec3d towards_eye = is_z_up ? Vec3d(0.6, -1, rise) : Vec3d(0.6, rise, 1);
  return frame_box(bounds, mesh_origin, -towards_eye, up, Camera{}.fov_degrees, aspect);
}

Vec3d zenith_of(const Camera& camera) {
  const Vec3d size = glm::abs(camera.up);
  int axis = 1;
  if (size.z > size[axis]) axis = 2;
  if (size.x > size[axis]) axis = 0;
  Vec3d zenith(0);
  zenith[axis] = camera.up[axis] < 0 ? -1 : 1;
  return zenith;
}

}  // namespace tracer
