// SPDX-License-Identifier: MIT
// How drags, the wheel and keys move a camera: a camera in, a camera out.
#pragma once

#include "tracer/scene/camera.h"

namespace app {

/// Turns the eye around the target as on a turntable with the axis `up`: `turn_radians.x` to the
/// right of what is seen, y towards its top; the elevation ends at the poles. A view straight down
/// or up keeps its heading in Camera::up.
tracer::Camera orbit(const tracer::Camera& camera, const tracer::Vec3d& up,
                     const tracer::Vec2d& turn_radians);

/// Moves eye and target so that what lies at the target's distance follows a drag, in pixels, y
/// down.
tracer::Camera pan(const tracer::Camera& camera, const tracer::Vec2d& drag_px,
                   double picture_height_px);

/// Multiplies the distance to the target by `factor` > 0. What lies under the cursor, given in
/// pixels from the picture's center, y down, at the target's distance stays under it. The distance
/// does not fall below `least_distance`.
tracer::Camera dolly(const tracer::Camera& camera, double factor, const tracer::Vec2d& cursor_px,
                     double picture_height_px, double least_distance);

enum class Axis { front, back, right, left, top, bottom };

/// Looks at the same target from the same distance along an axis of the world in which `up`, unit
/// length, is up: the front is +Z of a Y-up world and -Y of a Z-up world, as Blender and F3D have
/// it; a tilted world has what is nearest to that across `up`.
tracer::Camera look_along(const tracer::Camera& camera, Axis axis, const tracer::Vec3d& up);

}  // namespace app
