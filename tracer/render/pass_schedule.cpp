// SPDX-License-Identifier: MIT
#include "tracer/render/pass_schedule.h"

#include <algorithm>
#include <bit>

namespace tracer {

void PassSchedule::advance(Film& film) {
  constexpr uint32_t passes_before_rates = 16;
  pass_ = next_pass(pass_);
  const uint32_t done = pass_.sample;
  if (allocation_ == Allocation::adaptive && pass_.stride == 1 && done >= passes_before_rates &&
      std::has_single_bit(done)) {
    film.set_rates(SampleRates(film));
  }
}

bool PassSchedule::is_estimate_due() const {
  constexpr uint32_t first_estimate = 8;
  const uint32_t done = pass_.sample;
  return done >= first_estimate && done % (std::bit_floor(done) / first_estimate) == 0;
}

}  // namespace tracer
