// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace tracer {

/// Four well-mixed 32-bit words from four: the pcg4d hash of [Jarzynski 2020].
struct Words4 {
  uint32_t x, y, z, w;
};
inline Words4 hash_words(Words4 v) {
  v.x = v.x * 1664525u + 1013904223u;
  v.y = v.y * 1664525u + 1013904223u;
  v.z = v.z * 1664525u + 1013904223u;
  v.w = v.w * 1664525u + 1013904223u;
  v.x += v.y * v.w, v.y += v.z * v.x, v.z += v.x * v.y, v.w += v.y * v.z;
  v.x ^= v.x >> 16, v.y ^= v.y >> 16, v.z ^= v.z >> 16, v.w ^= v.w >> 16;
  v.x += v.y * v.w, v.y += v.z * v.x, v.z += v.x * v.y, v.w += v.y * v.z;
  return v;
}

/// Uniform in [0, 1) from the upper 24 bits: exact, and never 1.
inline float to_unit_float(uint32_t word) {
  return static_cast<float>(word >> 8) * 0x1p-24f;
}

}  // namespace tracer
