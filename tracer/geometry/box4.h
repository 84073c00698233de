// SPDX-License-Identifier: MIT
// Boxes as one SIMD register a corner.
#pragma once

#include <cstdint>
#include <cstring>

#include "tracer/geometry/box.h"

namespace tracer {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = int32_t __attribute__((vector_size(16)));

/// Lane w is 0.
inline Float4 lanes_of(const Vec3f& vector) {
  using Float2 = float __attribute__((vector_size(8)));
  Float2 xy;
  std::memcpy(&xy, &vector.x, sizeof xy);
  return Float4{xy[0], xy[1], vector.z, 0};
}

inline Float4 min_of(Float4 a, Float4 b) {
  return a < b ? a : b;
}
inline Float4 max_of(Float4 a, Float4 b) {
  return a > b ? a : b;
}

/// A Box of lanes x, y, z; lane w holds nothing of meaning. Empty when new.
struct Box4 {
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  Float4 min{infinity, infinity, infinity, infinity};
  Float4 max{-infinity, -infinity, -infinity, -infinity};

  Box4() = default;
  Box4(Float4 low, Float4 high) : min(low), max(high) {}
  explicit Box4(Float4 point) : min(point), max(point) {}
  explicit Box4(const Box& box) {
    static_assert(sizeof(Box) == 6 * sizeof(float));
    std::memcpy(&min, &box, sizeof min);
    std::memcpy(&max, reinterpret_cast<const float*>(&box) + 2, sizeof max);
    max = __builtin_shufflevector(max, max, 1, 2, 3, 0);
  }

  void extend(const Box4& other) {
    min = min_of(min, other.min);
    max = max_of(max, other.max);
  }
  void extend(Float4 point) {
    min = min_of(min, point);
    max = max_of(max, point);
  }
  Box box() const { return {{min[0], min[1], min[2]}, {max[0], max[1], max[2]}}; }
  bool is_empty() const { return box().is_empty(); }
  double half_area() const {
    const double x = static_cast<double>(max[0]) - min[0];
    const double y = static_cast<double>(max[1]) - min[1];
    const double z = static_cast<double>(max[2]) - min[2];
    return x >= 0 && y >= 0 && z >= 0 ? x * y + y * z + z * x : 0;
  }
};

inline Box4 intersection(const Box4& a, const Box4& b) {
  return {max_of(a.min, b.min), min_of(a.max, b.max)};
}

}  // namespace tracer
