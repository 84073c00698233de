// SPDX-License-Identifier: MIT
// The tables of ray tracers under comparison.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/compare/ray_sets.h"

namespace bench {

/// The primitive that was hit, or no_primitive; for occlusion `is_occluded` or no_primitive.
using Answer = uint32_t;
inline constexpr Answer is_occluded = 0;

/// Traces rays [first, last) of the set it was prepared for, answers[i] for ray i; from many
/// threads, never the same rays. `first` is a multiple of rays_a_block.
using TraceRange = std::function<void(size_t first, size_t last, std::span<Answer> answers)>;

struct Tracer {
  std::string name;  // begins with "boxwood" or "embree"
  /// Brings the rays into the tracer's own form, outside the timing. The set must outlive what is
  /// returned. No function: not a kind of rays for this tracer.
  std::function<TraceRange(const RaySet& set)> prepare;

  bool is_ours() const { return name.starts_with("boxwood"); }
};

/// Boxwood's ways to trace `accel`, which must outlive them. Single rays come first; `suffix` goes
/// to the end of the names.
std::vector<Tracer> boxwood_tracers(const tracer::Accel& accel, const std::string& suffix);

}  // namespace bench
