// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/render/render_settings.h"
#include "tracer/render/world.h"

namespace tracer {

/// A world's environment, or its constant sky, turned and made brighter as the settings say. Holds
/// references to the world. Directions are unit length up to rounding.
class Sky {
 public:
  Sky(const World& world, const RenderSettings& settings);

  Vec3d radiance(const Vec3d& direction) const {
    return strength_ * (map_ ? map_->radiance(to_map(direction)) : constant_);
  }

  /// A constant sky is not: rays that surfaces scatter find it as well as any.
  bool is_sampled() const { return map_ != nullptr && strength_ > 0; }
  /// Where is_sampled(). u uniform in [0, 1)^2.
  Environment::Sample sample(const Vec2d& u) const {
    Environment::Sample sample = map_->sample(u);
    sample.direction = from_map(sample.direction);
    return sample;
  }
  double pdf(const Vec3d& direction) const { return map_->pdf(to_map(direction)); }

 private:
  Vec3d to_map(const Vec3d& v) const {
    return glm::normalize(Vec3d(glm::dot(v, x_), glm::dot(v, y_), glm::dot(v, z_)));
  }
  Vec3d from_map(const Vec3d& v) const { return v.x * x_ + v.y * y_ + v.z * z_; }

  const Environment* map_;
  Vec3d constant_;
  double strength_;
  // The map's axes in the world.
  Vec3d x_, y_, z_;
};

}  // namespace tracer
