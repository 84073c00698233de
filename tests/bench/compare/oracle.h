// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "tests/bench/compare/ray_sets.h"

namespace bench {

struct OracleVerdict {
  size_t ray_count = 0;  // asked
  uint64_t disagreements = 0;
};

/// Compares single rays through `accel` with brute force over all triangles, bit for bit, on rays
/// spread evenly over the set: as many as take about a second, 2048 at most.
OracleVerdict ask_oracle(const tracer::Accel& accel, const RaySet& set);

}  // namespace bench
