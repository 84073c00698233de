// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tracer/bvh/trace/accel.h"
#include "tracer/scene/camera.h"
#include "tracer/scene/scene.h"

namespace tracer {

/// All that a ray can depend on. Never changed once made; replaced whole.
struct World {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Accel> accel;  // over scene->mesh
  CameraFrame camera;
  Vec3d sky{1.0};  // constant radiance from everywhere
};

}  // namespace tracer
