// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "tests/bench/compare/tracers.h"

namespace bench {
namespace {

using tracer::Accel;
using tracer::RayCaster;

constexpr size_t rays_a_call = 1024;

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

TraceRange prepare_many(const Accel& accel, const RaySet& set) {
  return [&](size_t first, size_t last, std::span<Answer> answers) {
    const tracer::StopFlag stop;
    RayCaster caster(accel, stop);
    const std::span<const tracer::Ray> rays(set.rays);
    std::array<tracer::Hit, rays_a_call> hits;
    std::array<uint8_t, rays_a_call> occluded;
    for (size_t i = first; i < last; i += rays_a_call) {
      const size_t count = std::min(rays_a_call, last - i);
      if (set.kind->query == Query::occluded) {
        caster.occluded(rays.subspan(i, count), {occluded.data(), count});
        for (size_t k = 0; k < count; ++k) {
          answers[i + k] = occluded[k] != 0 ? is_occluded : tracer::no_primitive;
        }
      } else {
        caster.closest_hits(rays.subspan(i, count), {hits.data(), count});
        for (size_t k = 0; k < count; ++k) answers[i + k] = hits[k].primitive;
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
    {"boxwood spans", prepare_many},
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
