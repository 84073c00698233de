// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

namespace bench {

/// Processors that this process may run on.
int processor_count();

/// Calls f(first, last) for parts of [0, count) that begin at multiples of `grain`, on so many
/// threads, each pinned to a processor of its own, the last ones first: the first serves
/// interrupts. Returns the processor seconds that the threads took, in the mean: the wall-clock
/// time of work that never waits on a machine with nothing else to do, and what else it does counts
/// not. `thread_count` is at most processor_count().
double run_pinned(int thread_count, size_t count, size_t grain,
                  const std::function<void(size_t first, size_t last)>& f);

}  // namespace bench
