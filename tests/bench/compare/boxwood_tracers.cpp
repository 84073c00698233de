// SPDX-License-Identifier: MIT
#include "tests/bench/compare/tracers.h"

namespace bench {
namespace {

using tracer::Accel;
using tracer::RayCaster;

TraceRange prepare_single(const Accel& accel, const RaySet& set) {
  return [&](size_t first, size_t last, std::span<Answer> answers) {
    const tracer::StopFlag stop;
    RayCaster caster(accel, stop);
    if (set.kind->query == Query::occluded) {
      for (size_t i = first; i < last; ++i) {
        answers[i] = caster.occluded(set.rays[i]) ? is_occluded : tracer::no_primitive;
      }
    } else {
      for (size_t i = first; i < last; ++i) {
        answers[i] = caster.closest_hit(set.rays[i]).primitive;
      }
    }
  };
}

struct Way {
  const char* name;
  TraceRange (*prepare)(const Accel& accel, const RaySet& set);
};

// To add a way to trace: one line here.
constexpr Way ways[] = {
    {"boxwood", prepare_single},
};

}  // namespace

std::vector<Tracer> boxwood_tracers(const Accel& accel, const std::string& suffix) {
  std::vector<Tracer> tracers;
  for (const Way& way : ways) {
    tracers.push_back(
        {way.name + suffix, [&accel, &way](const RaySet& set) { return way.prepare(accel, set); }});
  }
  return tracers;
}

}  // namespace bench
