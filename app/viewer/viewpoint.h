// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "app/viewer/camera_controls.h"
#include "app/viewer/orbit.h"
#include "app/viewer/up_axis.h"
#include "tracer/geometry/mesh.h"
#include "tracer/scene/view_file.h"

namespace app {

/// Where one model is seen from, and what is up there.
class Viewpoint {
 public:
  /// The view that the model opens in: `view`, or the default one. `aspect` is the picture's width
  /// over its height.
  void open(const tracer::Mesh& mesh, const std::optional<tracer::View>& view, double aspect);
  /// The same camera for a new version of the model.
  void reload(const tracer::Mesh& mesh);

  void reset(double aspect);
  void frame_all(double aspect);
  void look_along(Axis axis);
  /// Another world axis is up: looks from the default side as that axis has it.
  void set_up(UpAxis up, double aspect);
  void handle(const InputEvent& event, const PictureArea& area);
  void end_drag() { controls_.end_drag(); }

  const tracer::Camera& camera() const { return camera_; }

 private:
  tracer::Camera default_camera(double aspect) const;
  tracer::Vec3d up_vector() const;

  tracer::Camera camera_;
  std::optional<tracer::Camera> given_;  // by a view file
  UpAxis up_ = UpAxis::automatic;
  tracer::Box bounds_;
  tracer::Vec3d origin_{};
  CameraControls controls_;
};

}  // namespace app
