// SPDX-License-Identifier: MIT
#include "tests/bench/compare/kernel_judge.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>

#include "tests/bench/compare/true_hit.h"
#include "tracer/base/parallel.h"

namespace bench {
namespace {

using tracer::Ray;

/// Of one ray and one block.
struct Truth {
  uint32_t hits = 0;  // bit i: triangle i is met, at t[i]
  long double t[16];
};

std::vector<Truth> truths_of(const KernelBlock& block, std::span<const Ray> rays) {
  std::vector<Truth> truths(rays.size());
  for (size_t i = 0; i < rays.size(); ++i) {
    for (uint32_t k = 0; k < block.triangle_count(); ++k) {
      const auto t = true_hit(rays[i], block.corner(k, 0), block.corner(k, 1), block.corner(k, 2));
      if (!t) continue;
      truths[i].hits |= 1u << k;
      truths[i].t[k] = *t;
    }
  }
  return truths;
}

double error_ulp(double t, long double truth) {
  if (truth == 0) return t == 0 ? 0 : HUGE_VAL;
  const long double ulp = std::ldexp(1.0L, std::ilogb(truth) - 23);
  return static_cast<double>(std::abs(t - truth) / ulp);
}

Verdicts compare(const Aiming& aiming, const KernelBlock& block, std::span<const Truth> truths,
                 std::span<const Found> found) {
  Verdicts verdicts;
  for (size_t i = 0; i < truths.size(); ++i) {
    verdicts.tests += block.triangle_count();
    verdicts.hits += static_cast<uint64_t>(std::popcount(truths[i].hits));
    verdicts.wrong += static_cast<uint64_t>(std::popcount(truths[i].hits ^ found[i].hits));
    if (aiming.finds_leaks() && truths[i].hits != 0) {
      ++verdicts.aimed_rays;
      verdicts.leaks += found[i].hits == 0;
    }
    for (uint32_t bits = truths[i].hits & found[i].hits; bits != 0; bits &= bits - 1) {
      const auto k = static_cast<size_t>(std::countr_zero(bits));
      verdicts.t_error_ulp.add(error_ulp(found[i].t[k], truths[i].t[k]));
    }
  }
  return verdicts;
}

}  // namespace

size_t ErrorHistogram::bin_of(double error) {
  const double scaled = std::ldexp(error, -least_exponent);
  if (!(scaled >= 1)) return 0;
  if (std::isinf(scaled)) return bin_count - 1;
  const int exponent = std::ilogb(scaled);
  const double part = std::ldexp(scaled, -exponent) - 1;  // [0, 1)
  const size_t bin = 1 + static_cast<size_t>(exponent) * bins_an_octave +
                     static_cast<size_t>(part * bins_an_octave);
  return std::min(bin, bin_count - 1);
}

double ErrorHistogram::top_of(size_t bin) {
  const double part = static_cast<double>(bin % bins_an_octave) / bins_an_octave;
  return std::ldexp(1 + part, least_exponent + static_cast<int>(bin / bins_an_octave));
}

void ErrorHistogram::add(double error) {
  ++bins_[bin_of(error)];
  ++count_;
  max_ = std::max(max_, error);
}

void ErrorHistogram::add(const ErrorHistogram& other) {
  for (size_t i = 0; i < bin_count; ++i) bins_[i] += other.bins_[i];
  count_ += other.count_;
  max_ = std::max(max_, other.max_);
}

double ErrorHistogram::quantile(double part) const {
  const double wanted = part * static_cast<double>(count_);
  uint64_t passed = 0;
  for (size_t bin = 0; bin < bin_count; ++bin) {
    passed += bins_[bin];
    if (passed > 0 && static_cast<double>(passed) >= wanted) return std::min(top_of(bin), max_);
  }
  return max_;
}

void Verdicts::add(const Verdicts& other) {
  tests += other.tests;
  hits += other.hits;
  wrong += other.wrong;
  aimed_rays += other.aimed_rays;
  leaks += other.leaks;
  t_error_ulp.add(other.t_error_ulp);
}

std::vector<Verdicts> judge(std::span<const Kernel> kernels, const Aiming& aiming,
                            size_t block_count, size_t rays_a_block) {
  std::vector<Verdicts> sums(kernels.size());
  std::mutex mutex;
  tracer::parallel_for_each_index(0, block_count, [&](size_t index) {
    const auto seed = static_cast<uint32_t>(2 * index);
    const KernelBlock block = make_kernel_block(aiming, seed);
    const std::vector<Ray> rays = make_aimed_rays(aiming, block, rays_a_block, seed + 1);
    const std::vector<Truth> truths = truths_of(block, rays);
    std::vector<Found> found(rays.size());
    for (size_t i = 0; i < kernels.size(); ++i) {
      kernels[i].judge(block, rays)(found);
      const Verdicts verdicts = compare(aiming, block, truths, found);
      const std::lock_guard lock(mutex);
      sums[i].add(verdicts);
    }
  });
  return sums;
}

}  // namespace bench
