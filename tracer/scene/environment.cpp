// SPDX-License-Identifier: MIT
#include "tracer/scene/environment.h"

#include <algorithm>
#include <numbers>

#include "tracer/base/directions.h"
#include "tracer/base/trigonometry.h"

namespace tracer {

double Sun::solid_angle() const {
  return 2 * std::numbers::pi * (1 - cos_radius);
}

// By the distance of unit vectors, which tells small angles better than their cosines do.
bool Sun::covers(const Vec3d& towards) const {
  const Vec3d apart = towards - direction;
  return glm::dot(apart, apart) <= 2 * (1 - cos_radius);
}

Environment::Environment(SkyMap map, std::optional<Sun> sun) : map_(std::move(map)), sun_(sun) {
  if (!sun_) return;
  // A sun below the horizon of what it lights, or a black map, leaves the other its share.
  constexpr double least_share = 0.1;
  const double sun_power = luminance(sun_->radiance) * sun_->solid_angle();
  if (!(sun_power > 0)) {
    sun_.reset();
    return;
  }
  const double share = sun_power / (sun_power + map_.power());
  sun_share_ = map_.power() > 0 ? std::clamp(share, least_share, 1 - least_share) : 1;
}

Vec3d Environment::radiance(const Vec3d& direction) const {
  const Vec3d sky = map_.radiance(direction);
  return sun_ && sun_->covers(direction) ? sky + sun_->radiance : sky;
}

Environment::Sample Environment::sample(const Vec2d& u) const {
  if (u.x >= sun_share_) {
    Sample sample = map_.sample({(u.x - sun_share_) / (1 - sun_share_), u.y});
    if (sample.pdf > 0) sample.pdf = pdf(sample.direction);
    return sample;
  }
  const double drop = u.x / sun_share_ * (1 - sun_->cos_radius);
  const double level = std::sqrt(drop * (2 - drop));
  const CosSin around = cos_sin_of_turns(u.y);
  const Tangents tangents = tangents_of(sun_->direction);
  const Vec3d direction = level * around.cos * tangents.x + level * around.sin * tangents.y +
                          (1 - drop) * sun_->direction;
  return {direction, pdf(direction)};
}

double Environment::pdf(const Vec3d& direction) const {
  const double of_map = (1 - sun_share_) * map_.pdf(direction);
  if (!sun_ || !sun_->covers(direction)) return of_map;
  return of_map + sun_share_ / sun_->solid_angle();
}

}  // namespace tracer
