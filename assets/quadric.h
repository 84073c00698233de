// SPDX-License-Identifier: MIT
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "tracer/base/vectors.h"

namespace assets {

using tracer::Vec3d;

/// The weighted sum of squared distances to planes, as a function of the point. [Garland 1997]
class Quadric {
 public:
  /// `normal` is of unit length.
  void add_plane(const Vec3d& point, const Vec3d& normal, double weight) {
    const double offset = -glm::dot(normal, point);
    square_ += weight * glm::outerProduct(normal, normal);
    linear_ += weight * offset * normal;
    constant_ += weight * offset * offset;
  }

  Quadric& operator+=(const Quadric& other) {
    square_ += other.square_;
    linear_ += other.linear_;
    constant_ += other.constant_;
    return *this;
  }

  /// Never negative, though rounding would make it so.
  double operator()(const Vec3d& point) const {
    const double sum =
        glm::dot(point, square_ * point) + 2.0 * glm::dot(linear_, point) + constant_;
    return std::max(sum, 0.0);
  }

  /// The point where the sum is least, drawn towards `guess` where the planes leave it open.
  Vec3d least_near(const Vec3d& guess) const {
    const double pull = 1e-3 * (square_[0][0] + square_[1][1] + square_[2][2]);
    if (pull == 0.0) return guess;
    return glm::inverse(square_ + glm::dmat3(pull)) * (pull * guess - linear_);
  }

 private:
  glm::dmat3 square_{0.0};
  Vec3d linear_{0.0};
  double constant_ = 0.0;
};

}  // namespace assets
