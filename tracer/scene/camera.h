// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/base/vectors.h"
#include "tracer/geometry/box.h"
#include "tracer/geometry/ray.h"

namespace tracer {

/// A pinhole camera in world coordinates, as in a view file.
struct Camera {
  Vec3d eye{0, 0, 1};
  Vec3d target{0, 0, 0};
  Vec3d up{0, 1, 0};  // need not be perpendicular, nor unit length; parallel to the view is mended
  double fov_degrees = 39.6;  // vertical, 0 < fov < 180

  friend bool operator==(const Camera&, const Camera&) = default;
};

/// The camera resolved for one image size, relative to the origin of a mesh.
struct CameraFrame {
  Vec3f origin{};
  Vec3d forward{};     // unit length
  Vec3d right_step{};  // one pixel to the right on the plane at distance 1
  Vec3d down_step{};   // one pixel down
  Vec2d center_px{};   // the optical axis, in pixels
};

/// `size_px` at least 1x1; fov is brought into [1e-6, 179.9]. All in double; the origin is rounded
/// once.
CameraFrame make_camera_frame(const Camera& camera, Vec2i size_px, const Vec3d& mesh_origin);

/// The ray through image point (x, y) in pixels, (0, 0) the upper left corner of the upper left
/// pixel. Unit length up to one rounding.
Ray camera_ray(const CameraFrame& frame, const Vec2d& image_point_px);

/// False only where no camera_ray through [first_px, end_px] meets anything in `bounds`, which are
/// relative to the mesh's origin.
bool can_meet(const CameraFrame& frame, const Vec2d& first_px, const Vec2d& end_px,
              const Box& bounds);

/// The view along `view_direction`, from the eye into the scene, that shows all of `bounds`
/// (relative to `mesh_origin`) with a margin of some 5 %. `aspect` is width / height. `up` is the
/// world's up axis, see guess_up.
Camera frame_box(const Box& bounds, const Vec3d& mesh_origin, const Vec3d& view_direction,
                 const Vec3d& up, double fov_degrees, double aspect);

/// +Y, but +Z for what lies flat in z, as terrain in survey coordinates does.
Vec3d guess_up(const Box& bounds);

/// The axis of the world, up or down it, that is nearest to the camera's up.
Vec3d zenith_of(const Camera& camera);

/// The three-quarter view that a model opens in: from the front, right and above, and from
/// further above where the model is flat.
Camera default_camera(const Box& bounds, const Vec3d& mesh_origin, double aspect);

}  // namespace tracer
