// SPDX-License-Identifier: MIT
// GLM's vectors under the names the library uses.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace tracer {

using Vec2i = glm::ivec2;
using Vec2f = glm::vec2;
using Vec2d = glm::dvec2;
using Vec3f = glm::vec3;
using Vec3d = glm::dvec3;
using Vec3u = glm::uvec3;
using Vec4f = glm::vec4;

inline bool is_finite(const Vec3f& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool is_finite(const Vec3d& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline double max_abs(const Vec3d& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Rec. 709 luminance of linear RGB.
inline double luminance(const Vec3d& rgb) {
  return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
}

}  // namespace tracer
