// SPDX-License-Identifier: MIT
#include "app/viewer/camera_controls.h"

#include <cmath>
#include <numbers>

#include <GLFW/glfw3.h>

#include "app/viewer/orbit.h"

namespace app {
namespace {

// A drag over the picture's height is half a turn.
constexpr double turn_a_height = std::numbers::pi;
constexpr double wheel_factor = 0.87;    // of the distance, a step
constexpr double drag_log_factor = 2.5;  // of the distance, a drag over the height
// Nearer, as part of the scene's radius, there is nothing to see.
constexpr double least_distance = 1e-4;

}  // namespace

CameraControls::Drag CameraControls::drag_of(const InputEvent& press) {
  const bool has_shift = press.modifiers & GLFW_MOD_SHIFT;
  const bool has_control = press.modifiers & GLFW_MOD_CONTROL;
  if (press.code == GLFW_MOUSE_BUTTON_RIGHT) return Drag::pan;
  if (press.code != GLFW_MOUSE_BUTTON_LEFT && press.code != GLFW_MOUSE_BUTTON_MIDDLE) {
    return Drag::none;
  }
  if (has_control) return Drag::dolly;
  return has_shift ? Drag::pan : Drag::orbit;
}

tracer::Camera CameraControls::handle(const InputEvent& event, const tracer::Camera& camera,
                                      const Scene& scene, const PictureArea& area) {
  using Kind = InputEvent::Kind;
  const double height = area.size.y;
  switch (event.kind) {
    case Kind::button_press:
      if (drag_ == Drag::none && area.contains(event.cursor)) {
        drag_ = drag_of(event);
        button_ = event.code;
        cursor_ = event.cursor;
      }
      return camera;
    case Kind::button_release:
      if (event.code == button_) drag_ = Drag::none;
      return camera;
    case Kind::scroll: {
      if (!area.contains(event.cursor)) return camera;
      const tracer::Vec2d from_center = event.cursor - area.min - 0.5 * area.size;
      return dolly(camera, std::pow(wheel_factor, event.scroll.y), from_center, height,
                   least_distance * scene.radius);
    }
    case Kind::cursor: {
      const tracer::Vec2d moved = event.cursor - cursor_;
      if (drag_ == Drag::none) return camera;
      cursor_ = event.cursor;
      if (drag_ == Drag::orbit) return orbit(camera, scene.up, turn_a_height / height * moved);
      if (drag_ == Drag::pan) return pan(camera, moved, height);
      return dolly(camera, std::exp(drag_log_factor * moved.y / height), {0, 0}, height,
                   least_distance * scene.radius);
    }
    case Kind::key_press:
      return camera;
  }
  return camera;
}

}  // namespace app
