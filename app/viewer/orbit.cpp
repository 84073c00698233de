// SPDX-License-Identifier: MIT
#include "app/viewer/orbit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace app {
namespace {

using tracer::Camera;
using tracer::Vec2d;
using tracer::Vec3d;

constexpr double right_angle = std::numbers::pi / 2;

/// What the camera sees as to the right, up and ahead; unit length.
struct ViewAxes {
  Vec3d right;
  Vec3d up;
  Vec3d forward;
};

Vec3d any_perpendicular(const Vec3d& direction) {
  const Vec3d axis = std::abs(direction.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  return normalize(cross(direction, axis));
}

Vec3d forward_of(const Camera& camera) {
  const Vec3d forward = camera.target - camera.eye;
  return length(forward) > 0 ? normalize(forward) : Vec3d(0, 0, -1);
}

ViewAxes view_axes_of(const Camera& camera) {
  const Vec3d forward = forward_of(camera);
  const Vec3d right = cross(forward, camera.up);
  const bool is_parallel = !(length(right) > 1e-9 * length(camera.up));
  const Vec3d unit_right = is_parallel ? any_perpendicular(forward) : normalize(right);
  return {unit_right, cross(unit_right, forward), forward};
}

/// The horizontal direction, unit length, that a camera faces; for one that looks straight down or
/// up, its screen's upward or downward direction.
Vec3d heading_of(const Camera& camera, const Vec3d& up) {
  const ViewAxes axes = view_axes_of(camera);
  const Vec3d ahead = axes.forward - dot(axes.forward, up) * up;
  if (length(ahead) > 1e-6) return normalize(ahead);
  const double sign = dot(axes.forward, up) < 0 ? 1 : -1;
  const Vec3d on_screen = sign * (axes.up - dot(axes.up, up) * up);
  return length(on_screen) > 1e-6 ? normalize(on_screen) : any_perpendicular(up);
}

/// A camera at the target's distance that faces `heading` from `elevation` above it.
Camera place_eye(const Camera& camera, const Vec3d& up, const Vec3d& heading, double elevation) {
  const double distance = length(camera.target - camera.eye);
  Camera placed = camera;
  placed.up = up;
  Vec3d forward = std::cos(elevation) * heading - std::sin(elevation) * up;
  if (std::abs(elevation) >= right_angle) {
    forward = elevation > 0 ? -up : up;
    placed.up = elevation > 0 ? heading : -heading;
  }
  placed.eye = camera.target - distance * forward;
  return placed;
}

/// World lengths of a pixel on the plane through the target.
double pixel_size_world(const Camera& camera, double picture_height_px) {
  const double half_fov = camera.fov_degrees * std::numbers::pi / 360;
  return 2 * length(camera.target - camera.eye) * std::tan(half_fov) / picture_height_px;
}

}  // namespace

Camera orbit(const Camera& camera, const Vec3d& up, const Vec2d& turn_radians) {
  const Vec3d heading = heading_of(camera, up);
  const Vec3d side = cross(up, heading);
  const Vec3d turned = std::cos(turn_radians.x) * heading - std::sin(turn_radians.x) * side;
  const double sine = std::clamp(-dot(forward_of(camera), up), -1.0, 1.0);
  const double elevation = std::clamp(std::asin(sine) + turn_radians.y, -right_angle, right_angle);
  return place_eye(camera, up, turned, elevation);
}

Camera pan(const Camera& camera, const Vec2d& drag_px, double picture_height_px) {
  const ViewAxes axes = view_axes_of(camera);
  const double scale = pixel_size_world(camera, picture_height_px);
  const Vec3d shift = scale * (drag_px.y * axes.up - drag_px.x * axes.right);
  Camera panned = camera;
  panned.eye += shift;
  panned.target += shift;
  return panned;
}

Camera dolly(const Camera& camera, double factor, const Vec2d& cursor_px, double picture_height_px,
             double least_distance) {
  const double distance = length(camera.target - camera.eye);
  const double new_distance = std::max(distance * factor, std::min(distance, least_distance));
  if (!(distance > 0) || !std::isfinite(new_distance)) return camera;
  const ViewAxes axes = view_axes_of(camera);
  const double scale = pixel_size_world(camera, picture_height_px);
  const Vec3d under_cursor = scale * (cursor_px.x * axes.right - cursor_px.y * axes.up);
  Camera moved = camera;
  moved.target += (1 - new_distance / distance) * under_cursor;
  moved.eye = moved.target - new_distance * axes.forward;
  return moved;
}

Camera look_along(const Camera& camera, Axis axis, const Vec3d& up) {
  const bool is_z_up = std::abs(up.z) > std::abs(up.y);
  const Vec3d front = is_z_up ? Vec3d(0, 1, 0) : Vec3d(0, 0, -1);
  const Vec3d front_heading = normalize(front - dot(front, up) * up);
  const Vec3d right_heading = cross(up, front_heading);
  switch (axis) {
    case Axis::front:
      return place_eye(camera, up, front_heading, 0);
    case Axis::back:
      return place_eye(camera, up, -front_heading, 0);
    case Axis::right:
      return place_eye(camera, up, right_heading, 0);
    case Axis::left:
      return place_eye(camera, up, -right_heading, 0);
    case Axis::top:
      return place_eye(camera, up, front_heading, right_angle);
    case Axis::bottom:
      return place_eye(camera, up, front_heading, -right_angle);
  }
  return camera;
}

}  // namespace app
