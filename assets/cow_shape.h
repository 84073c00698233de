// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

#include "tracer/base/vectors.h"

namespace assets {

using tracer::Vec3d;

/// The cow as an implicit surface, in metres: y up, facing +x, standing on y = 0. Negative inside.
double cow_distance(const Vec3d& point);

/// The part of space where cow_distance may be negative.
inline constexpr double cow_lower[3] = {-1.02, -0.05, -0.48};
inline constexpr double cow_upper[3] = {1.36, 1.58, 0.40};

/// How much more than the trunk's an error of the shape shows at a point of the surface.
double cow_importance(const Vec3d& point);

/// What the surface is made of; later regions lie over earlier ones.
struct Region {
  std::string_view material;
  Vec3d color;                             // linear RGB
  double (*distance)(const Vec3d& point);  // negative inside, zero on its outline
};

inline constexpr std::string_view cow_hide = "hide_white";
inline constexpr Vec3d cow_hide_color = {0.78, 0.74, 0.68};
extern const std::array<Region, 7> cow_regions;

}  // namespace assets
