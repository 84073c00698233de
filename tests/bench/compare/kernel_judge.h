// SPDX-License-Identifier: MIT
// How often a ray-triangle test is wrong, and by how much.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tests/bench/compare/kernels.h"

namespace bench {

/// Counts of errors, not negative, in bins 1.1 % wide.
class ErrorHistogram {
 public:
  void add(double error);
  void add(const ErrorHistogram& other);

  uint64_t count() const { return count_; }
  double max() const { return max_; }
  /// At least the least value that `part` of all do not exceed, and at most 1.1 % above it; 0
  /// where nothing was added.
  double quantile(double part) const;

 private:
  // By the exponent and the first six bits behind the point; below 2^-60 all is one bin.
  static constexpr size_t bins_an_octave = 64;
  static constexpr int least_exponent = -60;
  static constexpr size_t bin_count = 160 * bins_an_octave;
  static size_t bin_of(double error);
  static double top_of(size_t bin);

  std::vector<uint64_t> bins_ = std::vector<uint64_t>(bin_count);
  uint64_t count_ = 0;
  double max_ = 0;
};

/// What a kernel said of some rays, beside the truth.
struct Verdicts {
  uint64_t tests = 0;          // one ray and one triangle
  uint64_t hits = 0;           // of these, in truth
  uint64_t wrong = 0;          // of these
  uint64_t aimed_rays = 0;     // that meet a closed fan, away from its rim
  uint64_t leaks = 0;          // of these: through the fan, as the kernel sees it
  ErrorHistogram t_error_ulp;  // of hits that are hits: in ulps of a float at the true distance

  void add(const Verdicts& other);
};

/// One for each kernel: `block_count` blocks of the aiming's kind with `rays_a_block` rays each.
std::vector<Verdicts> judge(std::span<const Kernel> kernels, const Aiming& aiming,
                            size_t block_count, size_t rays_a_block);

}  // namespace bench
