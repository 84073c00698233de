// SPDX-License-Identifier: MIT
// What top-down builders move about.
#pragma once

#include <cstring>

#include "tracer/geometry/box4.h"

namespace tracer {

/// 32 bytes: the box of a primitive, or of a part of it, and which one it is.
struct Reference {
  Vec3f min;
  uint32_t primitive;
  Vec3f max;
  float unused = 0;

  Reference(const Box& box, uint32_t index) : min(box.min), primitive(index), max(box.max) {}

  /// The primitive's bits are not in lane w, where they would be a slow denormal number.
  Box4 box() const {
    constexpr Int4 xyz{-1, -1, -1, 0};
    Int4 low;
    Box4 box;
    std::memcpy(&low, &min, sizeof low);
    low &= xyz;
    std::memcpy(&box.min, &low, sizeof low);
    std::memcpy(&box.max, &max, sizeof box.max);
    return box;
  }
};
static_assert(sizeof(Reference) == 32);

/// Of a set of references: their boxes, and half the centres of these.
struct SetBounds {
  Box4 boxes;
  Box4 half_centers;

  void extend(const Box4& box) {
    boxes.extend(box);
    half_centers.extend(half_center_of(box));
  }
  void extend(const SetBounds& other) {
    boxes.extend(other.boxes);
    half_centers.extend(other.half_centers);
  }
};

}  // namespace tracer
