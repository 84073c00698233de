// SPDX-License-Identifier: MIT
#include "tests/bench/compare/ray_runners.h"

#include <algorithm>

#include "tests/bench/compare/pinned_threads.h"

namespace bench {
namespace {

constexpr size_t rays_a_task = 16 * rays_a_block;

}  // namespace

double Runner::run(int thread_count) {
  return run_pinned(thread_count, answers.size(), rays_a_task,
                    [&](size_t first, size_t last) { trace(first, last, answers); });
}

std::vector<Runner> make_runners(const std::vector<Tracer>& tracers, const RaySet& set) {
  std::vector<Runner> runners;
  for (const Tracer& tracer : tracers) {
    TraceRange trace = tracer.prepare(set);
    if (trace) {
      runners.push_back(
          {&tracer, std::move(trace), std::vector<Answer>(set.rays.size(), is_occluded), {}});
    }
  }
  return runners;
}

RaySet fitted(const RaySet& set, const std::vector<Tracer>& tracers, double seconds) {
  constexpr size_t sample_stride = 64;
  const RaySet sample = thinned(set, sample_stride);
  double slowest = 0;
  for (Runner& runner : make_runners(tracers, sample)) {
    slowest = std::max(slowest, runner.run(1));
  }
  const double all = slowest * static_cast<double>(set.rays.size()) /
                     static_cast<double>(std::max<size_t>(sample.rays.size(), 1));
  return thinned(set, std::max<size_t>(static_cast<size_t>(all / seconds + 0.5), 1));
}

uint64_t count_differences(const Runner& runner, const Runner& other) {
  uint64_t count = 0;
  for (size_t i = 0; i < runner.answers.size(); ++i) {
    count += runner.answers[i] != other.answers[i];
  }
  return count;
}

void time_rounds(std::vector<Runner>& runners, int thread_count, int repeat_count) {
  for (Runner& runner : runners) {
    runner.seconds.clear();
    runner.run(thread_count);
  }
  for (int round = 0; round < repeat_count; ++round) {
    for (Runner& runner : runners) runner.seconds.push_back(runner.run(thread_count));
  }
}

}  // namespace bench
