// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "tracer/scene/sky_map.h"

namespace tracer {

/// A disc in the sky of equal radiance all over.
struct Sun {
  Vec3d direction{0, 1, 0};  // to its middle, unit length
  double cos_radius = 1;     // of half the angle across, below 1
  Vec3d radiance{};          // added to that of the map

  double solid_angle() const;
  /// `towards` is unit length.
  bool covers(const Vec3d& towards) const;
};

/// What is around a scene, with +y as its zenith: a map, and a sun where it has one.
class Environment {
 public:
  using Sample = SkyMap::Sample;

  explicit Environment(SkyMap map, std::optional<Sun> sun = {});

  Vec3d radiance(const Vec3d& direction) const;
  /// A direction of the map or of the sun by their luminance. u uniform in [0, 1)^2. pdf 0: all is
  /// black.
  Sample sample(const Vec2d& u) const;
  /// By solid angle, of `sample`.
  double pdf(const Vec3d& direction) const;
  const SkyMap& map() const { return map_; }
  const std::optional<Sun>& sun() const { return sun_; }

 private:
  SkyMap map_;
  std::optional<Sun> sun_;
  double sun_share_ = 0;  // probability of picking it
};

/// A Radiance .hdr or OpenEXR picture of all directions, as wide as twice its height. What is
/// negative or no number counts as black. Throws LoadError.
std::shared_ptr<const Environment> load_environment(const std::filesystem::path& path);

/// Whether load_environment knows the extension.
bool is_environment_file(const std::filesystem::path& path);

}  // namespace tracer
