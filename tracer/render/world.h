// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tracer/bvh/trace/accel.h"
#include "tracer/scene/camera.h"
#include "tracer/scene/environment.h"
#include "tracer/scene/scene.h"

namespace tracer {

/// All that a ray can depend on. Never changed once made; replaced whole.
struct World {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Accel> accel;  // over scene->mesh
  CameraFrame camera;
  Vec3d sky{1.0};  // constant radiance from everywhere, where there is no environment
  std::shared_ptr<const Environment> environment{};  // nullptr: none
  Vec3d zenith{0, 1, 0};  // of the environment: along an axis, unit length
};

}  // namespace tracer
