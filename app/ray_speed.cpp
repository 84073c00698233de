// SPDX-License-Identifier: MIT
#include "app/ray_speed.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include "app/stopwatch.h"
#include "tracer/base/parallel.h"
#include "tracer/bvh/uniform_lines.h"

namespace app {
namespace {

// The best of several counts: what else the machine does takes away and never adds.
constexpr int slice_count = 5;
constexpr double slice_seconds = 0.05;
constexpr size_t line_count = 1 << 16;
// Between two looks at the clock: few, because a ray may take long where the tree is poor.
constexpr size_t lines_a_look = 16;

std::vector<tracer::Ray> make_lines(const tracer::Box& bounds) {
  std::vector<tracer::Ray> lines(line_count);
  for (uint32_t i = 0; i < line_count; ++i) lines[i] = tracer::uniform_line(bounds, i);
  return lines;
}

// Rays a second, in millions, on all threads.
double trace_slice(const tracer::Accel& accel, const std::vector<tracer::Ray>& lines) {
  const tracer::StopFlag never;
  std::atomic<size_t> next{0};
  std::atomic<uint64_t> ray_count{0};
  const Stopwatch start;
  const auto thread_count = static_cast<size_t>(tracer::default_thread_count());
  tracer::parallel_for_each_index(0, thread_count, [&](size_t) {
    tracer::RayCaster rays(accel, never);
    while (start.seconds() < slice_seconds) {
      const size_t begin = next.fetch_add(lines_a_look);
      for (size_t i = begin; i < begin + lines_a_look; ++i) rays.closest_hit(lines[i % line_count]);
    }
    ray_count += rays.ray_count();
  });
  return 1e-6 * static_cast<double>(ray_count) / start.seconds();
}

}  // namespace

double measure_mrays_per_second(const tracer::Accel& accel) {
  const tracer::Box& bounds = accel.mesh->bounds;
  if (!(bounds.half_area() > 0)) return 0;
  const std::vector<tracer::Ray> lines = make_lines(bounds);
  double best = 0;
  for (int i = 0; i < slice_count; ++i) best = std::max(best, trace_slice(accel, lines));
  return best;
}

}  // namespace app
