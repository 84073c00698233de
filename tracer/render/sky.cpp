// SPDX-License-Identifier: MIT
#include "tracer/render/sky.h"

#include "tracer/base/trigonometry.h"

namespace tracer {

Sky::Sky(const World& world, const RenderSettings& settings)
    : map_(world.environment.get()),
      constant_(world.sky),
      strength_(settings.sky_strength),
      x_(1, 0, 0),
      y_(world.zenith) {
  if (!map_) return;
  // With +Y or +Z up, +x stays where it is, as in Blender.
  if (y_.x != 0) x_ = {0, -y_.x, 0};
  const Vec3d unturned_z = glm::cross(x_, y_);
  // Counter-clockwise as seen from above: from x towards -z.
  const CosSin turned = cos_sin_of_turns(settings.sky_rotation / 360);
  const Vec3d unturned_x = x_;
  x_ = turned.cos * unturned_x - turned.sin * unturned_z;
  z_ = turned.sin * unturned_x + turned.cos * unturned_z;
}

}  // namespace tracer
