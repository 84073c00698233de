// SPDX-License-Identifier: MIT
#include "app/viewer/viewpoint.h"

#include <cmath>

namespace app {
namespace {

using tracer::Vec3d;

constexpr Vec3d y_up{0, 1, 0};
constexpr Vec3d z_up{0, 0, 1};

/// A direction of a world in which `from` is up as it is in one in which `to` is.
Vec3d change_up(const Vec3d& direction, const Vec3d& from, const Vec3d& to) {
  if (from == to) return direction;
  if (to == z_up) return {direction.x, -direction.z, direction.y};
  return {direction.x, direction.z, -direction.y};
}

}  // namespace

Vec3d Viewpoint::up_vector() const {
  if (up_ == UpAxis::y) return y_up;
  if (up_ == UpAxis::z) return z_up;
  const Vec3d guessed = guess_up(bounds_);
  if (!given_) return guessed;
  // A view straight down or up keeps its heading in Camera::up.
  const Vec3d forward = normalize(given_->target - given_->eye);
  return std::abs(dot(forward, guessed)) > 1 - 1e-6 ? guessed : normalize(given_->up);
}

tracer::Camera Viewpoint::default_camera(double aspect) const {
  const tracer::Camera guessed = tracer::default_camera(bounds_, origin_, aspect);
  const Vec3d guessed_up = guess_up(bounds_);
  const Vec3d up = up_ == UpAxis::automatic ? guessed_up : up_vector();
  const Vec3d direction = change_up(guessed.target - guessed.eye, guessed_up, up);
  return frame_box(bounds_, origin_, direction, up, guessed.fov_degrees, aspect);
}

void Viewpoint::open(const tracer::Mesh& mesh, const std::optional<tracer::View>& view,
                     double aspect) {
  reload(mesh);
  given_.reset();
  if (view) given_ = view->camera;
  reset(aspect);
}

void Viewpoint::reload(const tracer::Mesh& mesh) {
  bounds_ = mesh.bounds;
  origin_ = mesh.origin;
}

void Viewpoint::reset(double aspect) {
  camera_ = given_ && up_ == UpAxis::automatic ? *given_ : default_camera(aspect);
}

void Viewpoint::frame_all(double aspect) {
  const Vec3d direction = camera_.target - camera_.eye;
  camera_ = frame_box(bounds_, origin_, direction, camera_.up, camera_.fov_degrees, aspect);
}

void Viewpoint::look_along(Axis axis) {
  camera_ = app::look_along(camera_, axis, up_vector());
}

void Viewpoint::set_up(UpAxis up, double aspect) {
  if (up == up_) return;
  up_ = up;
  reset(aspect);
}

void Viewpoint::handle(const InputEvent& event, const PictureArea& area) {
  const double radius = bounds_.is_empty() ? 1 : 0.5 * length(bounds_.extent());
  camera_ = controls_.handle(event, camera_, {up_vector(), radius}, area);
}

}  // namespace app
