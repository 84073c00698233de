// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "tracer/base/vectors.h"

namespace tracer {

/// What a model takes up, in its file's own coordinates; empty until it is extended.
struct WorldBounds {
  Vec3d min{std::numeric_limits<double>::infinity()};
  Vec3d max{-std::numeric_limits<double>::infinity()};

  void extend(const Vec3d& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void extend(const WorldBounds& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
};

}  // namespace tracer
