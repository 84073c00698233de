// SPDX-License-Identifier: MIT
#include "app/session_rates.h"

namespace app {
namespace {

constexpr double recent_seconds = 1.0;
// A rate from less than this says more about the clock than about the rays.
constexpr double least_seconds = 1e-3;

double mrays_per_second_of(uint64_t rays, double seconds) {
  return seconds >= least_seconds ? static_cast<double>(rays) / seconds * 1e-6 : 0;
}

}  // namespace

void TraceRates::add(TraceMode mode, uint64_t rays, double seconds, double end_seconds) {
  Total& total = mode == TraceMode::bvh ? bvh_ : brute_force_;
  total.rays += rays;
  total.seconds += seconds;
  recent_.push_back({{rays, seconds}, end_seconds});
  while (recent_.size() > 1 && recent_.front().end_seconds < end_seconds - recent_seconds) {
    recent_.pop_front();
  }
}

double TraceRates::recent_mrays_per_second() const {
  Total sum;
  for (const Stretch& stretch : recent_) {
    sum.rays += stretch.total.rays;
    sum.seconds += stretch.total.seconds;
  }
  return mrays_per_second_of(sum.rays, sum.seconds);
}

double TraceRates::mrays_per_second(TraceMode mode) const {
  const Total& total = mode == TraceMode::bvh ? bvh_ : brute_force_;
  return mrays_per_second_of(total.rays, total.seconds);
}

}  // namespace app
