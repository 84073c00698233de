// SPDX-License-Identifier: MIT
// Signed distance bounds, negative inside, and the smooth operations that join them. Only
// arithmetic and square roots, so that every machine computes the same surface.
#pragma once

#include "tracer/base/vectors.h"

namespace assets {

using tracer::Vec3d;

struct Ball {
  Vec3d center;
  Vec3d radii;  // along x, y, z
};

/// The hull of two spheres.
struct Cone {
  Vec3d from, to;
  double from_radius, to_radius;
  double breadth = 1.0;  // stretches the z direction about the axis
};

/// Not exact away from the surface, where it is the first-order estimate.
inline double distance_to(const Ball& ball, const Vec3d& point) {
  const Vec3d scaled = (point - ball.center) / ball.radii;
  const double length = glm::length(scaled);
  const double slope = glm::length(scaled / ball.radii);
  if (slope == 0.0) return -std::min({ball.radii.x, ball.radii.y, ball.radii.z});
  return length * (length - 1.0) / slope;
}

inline double distance_to(const Cone& cone, const Vec3d& point) {
  const Vec3d squash(1.0, 1.0, 1.0 / cone.breadth);
  const Vec3d axis = (cone.to - cone.from) * squash;
  const Vec3d offset = (point - cone.from) * squash;
  const double length = glm::length(axis);
  const double along = glm::dot(offset, axis) / length;
  const double across = std::sqrt(std::max(0.0, glm::dot(offset, offset) - along * along));
  const double sine = (cone.from_radius - cone.to_radius) / length;
  const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  // Where the nearest point of the slanted side lies along the axis.
  const double foot = std::clamp(along + across * sine / cosine, 0.0, length);
  const double radius = cone.from_radius + (cone.to_radius - cone.from_radius) * foot / length;
  const double distance = std::sqrt((along - foot) * (along - foot) + across * across) - radius;
  return distance * std::min(1.0, cone.breadth);
}

/// The union of two shapes, with a fillet as wide as `blend`; twice continuously differentiable.
inline double join(double a, double b, double blend) {
  const double overlap = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - overlap * overlap * overlap * blend / 6.0;
}

/// `a` without `b`, with a rounded rim.
inline double carve(double a, double b, double blend) {
  return -join(-a, b, blend);
}

}  // namespace assets
