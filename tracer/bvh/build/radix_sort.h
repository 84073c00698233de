// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "tracer/base/progress.h"
#include "tracer/bvh/build/subdivide.h"

namespace tracer {

/// A primitive and where it lies along a curve. 8 bytes.
struct CurveKey {
  uint32_t code;
  uint32_t primitive;
};

/// Sorts by code, stably, and returns which of the two, of one length, has the keys then: the other
/// holds nothing of meaning. Codes have `code_bits`, 2 to 32. In parallel where there is much.
/// Throws Cancelled.
std::span<const CurveKey> radix_sort(std::span<CurveKey> keys, std::span<CurveKey> scratch,
                                     int code_bits, const Progress& progress);

}  // namespace tracer
