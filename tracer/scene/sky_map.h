// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "tracer/base/vectors.h"
#include "tracer/scene/distribution_2d.h"

namespace tracer {

/// Linear radiance by direction, row 0 at the zenith, columns by azimuth.
struct LatLongImage {
  int width = 0;
  int height = 0;
  std::vector<Vec3f> texels;
};

/// Radiance from all directions. +y is the zenith; the middle of the image lies towards +x and what
/// is right of it towards +z, as in Blender.
class SkyMap {
 public:
  struct Sample {
    Vec3d direction;  // unit length
    double pdf = 0;   // by solid angle
  };

  SkyMap() = default;
  /// The texels are finite and not negative.
  explicit SkyMap(LatLongImage image);

  /// Bilinear between the texels' centres. `direction` is unit length.
  Vec3d radiance(const Vec3d& direction) const;
  /// By the luminance of each texel times its solid angle. u uniform in [0, 1)^2.
  Sample sample(const Vec2d& u) const;
  /// By solid angle, of `sample`.
  double pdf(const Vec3d& direction) const;
  /// Luminance integrated over all directions.
  double power() const { return power_; }
  const LatLongImage& image() const { return image_; }

 private:
  Vec2d place_of(const Vec3d& direction) const;  // in texels
  double cell_measure(int row) const;            // solid angle of a texel

  LatLongImage image_;
  std::vector<double> heights_;  // y of the rows' upper edges, and of the last lower one
  Distribution2d cells_;
  double power_ = 0;
};

}  // namespace tracer
