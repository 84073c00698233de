// SPDX-License-Identifier: MIT
// Ray-triangle tests: time against error.
#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "tests/bench/compare/commands.h"
#include "tests/bench/compare/kernel_judge.h"
#include "tests/bench/compare/kernel_records.h"
#include "tests/bench/compare/machine.h"
#include "tests/bench/compare/pinned_threads.h"
#include "tests/bench/compare/report_files.h"

namespace bench {
namespace {

// What is timed stays in a core's own cache.
constexpr uint32_t timed_blocks = 32;
constexpr size_t timed_rays_a_block = 64;
constexpr double seconds_a_round = 0.005;
constexpr int rounds_a_repeat = 6;

/// A kernel ready to run on all timed blocks.
class TimedKernel {
 public:
  TimedKernel(const Kernel& kernel, std::span<const KernelBlock> blocks,
              std::span<const std::vector<tracer::Ray>> rays)
      : found_(timed_rays_a_block) {
    for (size_t i = 0; i < blocks.size(); ++i) {
      tests_.push_back(kernel.prepare(blocks[i], rays[i]));
      test_count_ += static_cast<double>(rays[i].size()) * blocks[i].triangle_count();
    }
    const double seconds = run();
    passes_ = std::clamp(static_cast<int>(seconds_a_round / seconds), 1, 10'000);
  }

  void run_round() { nanoseconds_.push_back(1e9 * run() / (test_count_ * passes_)); }
  const std::vector<double>& nanoseconds_a_test() const { return nanoseconds_; }

 private:
  double run() {
    return run_pinned(1, 1, 1, [this](size_t, size_t) {
      for (int pass = 0; pass < passes_; ++pass) {
        for (const TestRays& test : tests_) test(found_);
      }
    });
  }

  std::vector<TestRays> tests_;
  std::vector<Found> found_;
  double test_count_ = 0;
  int passes_ = 1;
  std::vector<double> nanoseconds_;
};

// Round by round, each kernel once, so that noise meets all of them.
std::vector<Spread> time_kernels(std::span<const Kernel> all, const Aiming& aiming,
                                 int repeat_count) {
  std::vector<KernelBlock> blocks;
  std::vector<std::vector<tracer::Ray>> rays;
  for (uint32_t i = 0; i < timed_blocks; ++i) {
    blocks.push_back(make_kernel_block(aiming, 2 * i));
    rays.push_back(make_aimed_rays(aiming, blocks.back(), timed_rays_a_block, 2 * i + 1));
  }
  std::vector<TimedKernel> timed;
  for (const Kernel& kernel : all) timed.emplace_back(kernel, blocks, rays);
  for (int round = 0; round < repeat_count * rounds_a_repeat; ++round) {
    for (TimedKernel& kernel : timed) kernel.run_round();
  }
  std::vector<Spread> times;
  for (const TimedKernel& kernel : timed) times.push_back(spread_of(kernel.nanoseconds_a_test()));
  return times;
}

// Of rays away from the block, only a call can tell the time.
std::vector<Kernel> kernels_for(const Aiming& aiming) {
  std::vector<Kernel> chosen = kernels();
  if (aiming.aim == Aim::away) {
    std::erase_if(chosen, [](const Kernel& kernel) { return kernel.form != Form::call; });
  }
  return chosen;
}

KernelRecord make_record(const Kernel& kernel, const Aiming& aiming, const Spread& time,
                         const Verdicts& verdicts) {
  return {.kernel = std::string(kernel.name),
          .form = std::string(name_of(kernel.form)),
          .rays = std::string(aiming.name),
          .nanoseconds_a_test = time,
          .tests = verdicts.tests,
          .hits = verdicts.hits,
          .wrong_verdicts = verdicts.wrong,
          .aimed_rays = verdicts.aimed_rays,
          .leaks = verdicts.leaks,
          .t_error_p9999_ulp = verdicts.t_error_ulp.quantile(0.9999),
          .t_error_max_ulp = verdicts.t_error_ulp.max()};
}

}  // namespace

int compare_kernels(const Options& options) {
  const bool is_quick = options.effort == Effort::quick;
  const size_t block_count = is_quick ? 16 : 256;
  const size_t rays_a_block_count = is_quick ? 256 : 4096;
  const std::string machine = machine_line();
  fmt::print(
      "{}\ntimes with what depends on a ray alone prepared; errors of t in ulps of a float\n",
      machine);
  std::vector<KernelRecord> records;
  size_t judged_count = 0;  // records of rays that may hit, which come first
  for (const Aiming& aiming : aimings()) {
    const std::vector<Kernel> all = kernels_for(aiming);
    if (all.empty()) continue;
    const std::vector<Spread> times = time_kernels(all, aiming, options.repeat_count);
    const std::vector<Verdicts> verdicts = judge(all, aiming, block_count, rays_a_block_count);
    fmt::print("{}: rays {}; they hit {:.1f} % of what they are tested against\n", aiming.name,
               aiming.what, 1e-4 * a_million(verdicts.front().hits, verdicts.front().tests));
    const size_t first = records.size();
    for (size_t i = 0; i < all.size(); ++i) {
      records.push_back(make_record(all[i], aiming, times[i], verdicts[i]));
    }
    fmt::print("{}", kernel_table(std::span(records).subspan(first)));
    std::fflush(stdout);
    if (aiming.aim != Aim::away) judged_count = records.size();
  }
  const std::vector<KernelRecord> summary = summarised(std::span(records).first(judged_count));
  fmt::print("\nall rays; the time is that on random rays\n{}", kernel_table(summary));
  write_report(options.folder / "kernels", records, kernel_chart(summary, machine));
  const bool is_wrong = std::ranges::any_of(summary, [](const KernelRecord& record) {
    return record.is_ours() && (record.wrong_verdicts > 0 || record.leaks > 0);
  });
  return is_wrong ? 1 : 0;
}

}  // namespace bench
