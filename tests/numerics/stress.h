// SPDX-License-Identifier: MIT
// Properties under millions of trials: what the tests of this folder share. A table of all results
// ends the run. Where the environment variable BOXWOOD_NUMERICS names a file, as ./check numerics
// has it, there are very many trials, and the results go into that file as JSON.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/random_source.h"
#include "tracer/base/parallel.h"
#include "tracer/geometry/ray.h"

namespace tracer::stress {

bool is_long();

/// How many trials to make: `in_short` by default, a fiftieth of them (at least one) under a
/// sanitizer, `in_long` in the long form.
uint64_t trials(uint64_t in_short, uint64_t in_long);

/// What came of the trials of one property.
struct Tally {
  uint64_t checks = 0;
  uint64_t failures = 0;
  uint64_t control_checks = 0;  // of what is known to be wrong, on the same input
  uint64_t control_failures = 0;
  double worst = 0;                  // of what was measured, if anything was
  std::vector<std::string> replays;  // of the first failures

  double control_failures_per_million() const;
  void add(const Tally& other);
};

/// One trial: its random numbers are a function of the seed and the index, so it can be replayed.
class Trial {
 public:
  Trial(uint32_t seed, uint64_t trial_index, Tally& tally)
      : random(seed, trial_index), index(trial_index), seed_(seed), tally_(tally) {}

  RandomSource random;
  const uint64_t index;

  /// `replay()` says in words and C++ literals how to see a failure again.
  template <class Replay>
  void check(bool holds, const Replay& replay) {
    ++tally_.checks;
    if (!holds) fail(replay());
  }
  void check_control(bool holds) {
    ++tally_.control_checks;
    tally_.control_failures += holds ? 0 : 1;
  }
  void measure(double value) { tally_.worst = std::max(tally_.worst, value); }

 private:
  void fail(const std::string& replay);

  uint32_t seed_;
  Tally& tally_;
};

/// Says on stderr now and then how far a long run is. Callable from many threads.
class ProgressLine {
 public:
  ProgressLine(std::string_view property, uint64_t trial_count);
  ~ProgressLine();
  void done(uint64_t trial_count);

 private:
  std::string property_;
  uint64_t total_;
  uint64_t done_ = 0;
  double last_seconds_ = 0;
  std::mutex mutex_;
};

/// Calls f(Trial&) `trial_count` times, from many threads.
template <class F>
Tally run_trials(std::string_view property, uint32_t seed, uint64_t trial_count, const F& f) {
  const uint64_t trials_a_chunk = std::max<uint64_t>(1, std::min<uint64_t>(1024, trial_count / 64));
  Tally total;
  std::mutex mutex;
  ProgressLine progress(property, trial_count);
  parallel_in_order((trial_count + trials_a_chunk - 1) / trials_a_chunk, [&](size_t chunk) {
    const uint64_t begin = chunk * trials_a_chunk;
    const uint64_t end = std::min(begin + trials_a_chunk, trial_count);
    Tally tally;
    for (uint64_t i = begin; i < end; ++i) {
      Trial trial(seed, i, tally);
      f(trial);
    }
    progress.done(end - begin);
    const std::scoped_lock lock(mutex);
    total.add(tally);
  });
  return total;
}

/// Fails the test, with replays, unless there were checks and all held; notes the result.
void expect_holds(std::string_view property, const Tally& tally);
/// The same, and fails unless the control fails at least so often, else the test could not fail;
/// not asked under a sanitizer.
void expect_holds_and_control_fails(std::string_view property, const Tally& tally,
                                    double least_per_million);

/// run_trials and expect_holds.
template <class F>
void expect_in_all_trials(std::string_view property, uint32_t seed, uint64_t trial_count,
                          const F& f) {
  expect_holds(property, run_trials(property, seed, trial_count, f));
}

/// As C++ literals, bit for bit: "0x1.8p+1f", "{0x0p+0f, ...}".
std::string literal(float value);
std::string literal(const Vec3f& vector);
/// "Ray{.origin{...}, .direction{...}}", with the interval where it is not the default.
std::string literal(const Ray& ray);

}  // namespace tracer::stress
