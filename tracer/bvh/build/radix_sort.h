// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "tracer/base/progress.h"
#include "tracer/bvh/build/subdivide.h"

namespace tracer {

/// A primitive and where it lies along a curve, 30 bits. 8 bytes.
struct CurveKey {
  uint32_t code;
  uint32_t primitive;
};

/// Sorts keys[range] by code, stably; `scratch` is as long as keys. In parallel where there is
/// much. Throws Cancelled.
void radix_sort(std::span<CurveKey> keys, std::span<CurveKey> scratch, PrimitiveRange range,
                const Progress& progress);

}  // namespace tracer
