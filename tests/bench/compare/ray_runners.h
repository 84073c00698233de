// SPDX-License-Identifier: MIT
// Tracers timed on the same rays, in turns.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/bench/compare/tracers.h"

namespace bench {

/// A tracer ready to run on one set of rays.
struct Runner {
  const Tracer* tracer;
  TraceRange trace;
  std::vector<Answer> answers;
  std::vector<double> seconds;  // one a round

  double run(int thread_count);
};

/// Of the tracers that take rays of the set's kind. Both outlive the runners.
std::vector<Runner> make_runners(const std::vector<Tracer>& tracers, const RaySet& set);

/// So few of the rays that the slowest tracer takes no longer than `seconds`, measured on one ray
/// in 64.
RaySet fitted(const RaySet& set, const std::vector<Tracer>& tracers, double seconds);

/// Round by round, each runner once, so that noise meets all of them; a round before those counts
/// not.
void time_rounds(std::vector<Runner>& runners, int thread_count, int repeat_count);

/// Rays that the two answered differently.
uint64_t count_differences(const Runner& runner, const Runner& other);

}  // namespace bench
