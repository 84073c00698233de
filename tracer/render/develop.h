// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "tracer/base/vectors.h"

namespace tracer {

/// An 8-bit sRGB pixel as OpenGL takes it.
struct Rgba8 {
  uint8_t r = 0, g = 0, b = 0, a = 255;
  friend bool operator==(const Rgba8&, const Rgba8&) = default;
};

/// The nearest 8-bit sRGB code [IEC 61966-2-1] of a linear value; below 0 and NaN give 0, above 1
/// gives 255.
uint8_t encode_srgb(float linear);

/// Linear radiance times 2^exposure, encoded. Sizes are equal.
void develop(std::span<const Vec3f> radiance, double exposure, std::span<Rgba8> out);

}  // namespace tracer
