// SPDX-License-Identifier: MIT
#include "tests/bench/compare/oracle.h"

#include <algorithm>
#include <atomic>

#include "tracer/base/parallel.h"

namespace bench {
namespace {

constexpr size_t triangle_tests = 60'000'000;
constexpr size_t most_rays = 2048;

bool is_same(const tracer::Hit& a, const tracer::Hit& b) {
  return a.primitive == b.primitive && a.t == b.t && a.u == b.u && a.v == b.v;
}

bool agree(tracer::RayCaster& a, tracer::RayCaster& b, const tracer::Ray& ray, Query query) {
  if (query == Query::occluded) return a.occluded(ray) == b.occluded(ray);
  return is_same(a.closest_hit(ray), b.closest_hit(ray));
}

}  // namespace

OracleVerdict ask_oracle(const tracer::Accel& accel, const RaySet& set) {
  const tracer::Accel brute_force{accel.mesh};
  const size_t affordable = triangle_tests / std::max<size_t>(accel.mesh->triangle_count(), 1);
  const size_t count = std::min(set.rays.size(), std::clamp<size_t>(affordable, 4, most_rays));
  std::atomic<uint64_t> disagreements{0};
  tracer::parallel_for_each_index(0, count, [&](size_t i) {
    const tracer::StopFlag stop;
    tracer::RayCaster by_tree(accel, stop);
    tracer::RayCaster by_force(brute_force, stop);
    const tracer::Ray& ray = set.rays[i * set.rays.size() / count];
    if (!agree(by_tree, by_force, ray, set.kind->query)) ++disagreements;
  });
  return {count, disagreements};
}

}  // namespace bench
