// SPDX-License-Identifier: MIT
#pragma once

#include "app/viewer/window.h"
#include "tracer/scene/camera.h"

namespace app {

/// Where the picture is, in window coordinates.
struct PictureArea {
  tracer::Vec2d min{};
  tracer::Vec2d size{1, 1};

  bool contains(const tracer::Vec2d& point) const {
    const tracer::Vec2d offset = point - min;
    return offset.x >= 0 && offset.y >= 0 && offset.x < size.x && offset.y < size.y;
  }
};

/// Mouse events to camera moves; remembers the drag in progress.
class CameraControls {
 public:
  /// What the mouse moves, and about what.
  struct Scene {
    tracer::Vec3d up{0, 1, 0};
    double radius = 1;  // of what there is to see
  };

  /// The camera after the event. A press or a scroll outside `area` moves nothing.
  tracer::Camera handle(const InputEvent& event, const tracer::Camera& camera, const Scene& scene,
                        const PictureArea& area);
  void end_drag() { drag_ = Drag::none; }
  bool is_dragging() const { return drag_ != Drag::none; }

 private:
  enum class Drag { none, orbit, pan, dolly };
  static Drag drag_of(const InputEvent& press);

  Drag drag_ = Drag::none;
  int button_ = 0;
  tracer::Vec2d cursor_{};  // at the last event of the drag
};

}  // namespace app
