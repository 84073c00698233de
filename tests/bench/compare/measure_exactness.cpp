// SPDX-License-Identifier: MIT
// The production traversal with exact leaves beside the same with Moeller-Trumbore leaves.
#include <algorithm>
#include <array>
#include <cstdio>

#include <fmt/format.h>

#include "tests/bench/compare/choose.h"
#include "tests/bench/compare/commands.h"
#include "tests/bench/compare/exactness_records.h"
#include "tests/bench/compare/machine.h"
#include "tests/bench/compare/moeller_kernels.h"
#include "tests/bench/compare/ray_runners.h"
#include "tests/bench/compare/report_files.h"
#include "tracer/bvh/build.h"
#include "tracer/bvh/trace/bundle_kernels.h"
#include "tracer/bvh/trace/wide_kernels.h"

namespace bench {
namespace {

using tracer::Hit;
using tracer::Ray;
using tracer::StopFlag;
using tracer::WideTree;

constexpr size_t rays_a_call = 1024;
// Many short rounds: what is compared runs within a few milliseconds of each other.
constexpr int rounds_a_repeat = 8;

struct Leaves {
  bool (*closest_hit)(const WideTree& tree, const Ray& ray, const StopFlag& stop, Hit& hit);
  bool (*occluded)(const WideTree& tree, const Ray& ray, const StopFlag& stop, Hit& hit);
  size_t (*closest_hits)(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                         std::span<Hit> hits);
  size_t (*occluded_rays)(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                          std::span<uint8_t> is_occluded);
};

constexpr Leaves exact{tracer::closest_hit_wide, tracer::occluded_wide, tracer::closest_hits_stream,
                       tracer::occluded_stream};
constexpr Leaves moeller_trumbore{closest_hit_moeller, occluded_moeller,
                                  closest_hits_stream_moeller, occluded_stream_moeller};

Answer occlusion(bool is_hit) {
  return is_hit ? is_occluded : tracer::no_primitive;
}

TraceRange prepare_single(const WideTree& tree, const Leaves& leaves, const RaySet& set) {
  return [&](size_t first, size_t last, std::span<Answer> answers) {
    const StopFlag stop;
    const bool is_occlusion = set.kind->query == Query::occluded;
    const auto trace = is_occlusion ? leaves.occluded : leaves.closest_hit;
    for (size_t i = first; i < last; ++i) {
      Hit hit;
      if (!trace(tree, set.rays[i], stop, hit)) hit = {};
      answers[i] = is_occlusion ? occlusion(hit.is_hit()) : hit.primitive;
    }
  };
}

// What ends a stream, a ray out of the kernels' range, counts as a miss.
template <class Value, class Trace, class Keep>
void trace_stream(const WideTree& tree, std::span<const Ray> rays, const Trace& trace,
                  const Keep& keep) {
  const StopFlag stop;
  std::array<Value, rays_a_call> values;
  for (size_t first = 0; first < rays.size();) {
    const size_t count = std::min(rays_a_call, rays.size() - first);
    const size_t done = trace(tree, rays.subspan(first, count), stop, {values.data(), count});
    for (size_t i = 0; i < done; ++i) keep(first + i, values[i]);
    first += std::max<size_t>(done, 1);
  }
}

TraceRange prepare_streams(const WideTree& tree, const Leaves& leaves, const RaySet& set) {
  return [&](size_t first, size_t last, std::span<Answer> answers) {
    const auto rays = std::span(set.rays).subspan(first, last - first);
    if (set.kind->query == Query::occluded) {
      trace_stream<uint8_t>(tree, rays, leaves.occluded_rays, [&](size_t i, uint8_t answer) {
        answers[first + i] = occlusion(answer != 0);
      });
    } else {
      trace_stream<Hit>(tree, rays, leaves.closest_hits,
                        [&](size_t i, const Hit& hit) { answers[first + i] = hit.primitive; });
    }
  };
}

struct Way {
  const char* name;
  TraceRange (*prepare)(const WideTree& tree, const Leaves& leaves, const RaySet& set);
};
constexpr Way ways[] = {{"single", prepare_single}, {"streams", prepare_streams}};

constexpr RayKind far_camera{"F", "far camera", Query::closest_hit};

// The camera's rays again, aimed at the same points from 10,000 times the model's size away.
RaySet far_camera_rays(const Scene& scene, const RaySet& camera) {
  const tracer::Vec3d target(scene.target);
  const tracer::Vec3d way = target - tracer::Vec3d(scene.eye);
  const double distance = 1e4 * glm::length(scene.mesh->bounds.extent());
  const tracer::Vec3f eye(target - distance * glm::normalize(way));
  RaySet far{&far_camera, {}};
  for (const Ray& ray : camera.rays) {
    const tracer::Vec3d point =
        tracer::Vec3d(ray.origin) + glm::length(way) * tracer::Vec3d(ray.direction);
    far.rays.push_back(
        {.origin = eye, .direction = tracer::Vec3f(glm::normalize(point - tracer::Vec3d(eye)))});
  }
  return far;
}

std::vector<double> speeds(const Runner& runner) {
  std::vector<double> speeds;
  for (const double seconds : runner.seconds) {
    speeds.push_back(static_cast<double>(runner.answers.size()) / 1e6 / seconds);
  }
  return speeds;
}

tracer::VisitCounts visits_of(const WideTree& tree, const RaySet& set) {
  const StopFlag stop;
  tracer::VisitCounts counts;
  for (const Ray& ray : set.rays) {
    Hit hit;
    [[maybe_unused]] const bool is_in_range = set.kind->query == Query::occluded
                                                  ? occluded_wide(tree, ray, stop, hit, counts)
                                                  : closest_hit_wide(tree, ray, stop, hit, counts);
  }
  return counts;
}

ExactnessRecord measure_set(const WideTree& tree, const RaySet& all, const Way& way,
                            const Options& options) {
  const auto tracer_with = [&](const char* name, const Leaves& leaves) {
    return Tracer{name, [&](const RaySet& set) { return way.prepare(tree, leaves, set); }};
  };
  const std::vector<Tracer> tracers{tracer_with("exact", exact),
                                    tracer_with("moeller-trumbore", moeller_trumbore)};
  const RaySet set = fitted(all, tracers, options.seconds_a_run / rounds_a_repeat);
  std::vector<Runner> runners = make_runners(tracers, set);
  time_rounds(runners, 1, options.repeat_count * rounds_a_repeat);
  ExactnessRecord record;
  record.rays = set.kind->name;
  record.way = way.name;
  record.exact_mrays_per_second = spread_of(speeds(runners[0]));
  record.moeller_mrays_per_second = spread_of(speeds(runners[1]));
  record.speed_ratio = paired_ratio(runners[1].seconds, runners[0].seconds);
  record.ray_count = set.rays.size();
  const tracer::VisitCounts visits = visits_of(tree, set);
  const auto ray_count = static_cast<double>(std::max<size_t>(record.ray_count, 1));
  record.blocks = static_cast<double>(visits.blocks) / ray_count;
  record.exact_tests = static_cast<double>(visits.exact_tests) / ray_count;
  record.disagreements = count_differences(runners[0], runners[1]);
  return record;
}

std::vector<ExactnessRecord> measure_scene(const Scene& scene, const Options& options) {
  tracer::Progress progress;
  const tracer::Builder& builder = tracer::builders().front();
  const tracer::Accel accel =
      make_accel(scene.mesh, builder.build(primitive_boxes(*scene.mesh), {}, progress),
                 tracer::layouts().front(), progress);
  std::vector<ExactnessRecord> records;
  if (!accel.wide) return records;
  std::vector<RaySet> sets =
      make_ray_sets(scene, accel, options.effort == Effort::quick ? 256 : 1024);
  sets.push_back(far_camera_rays(scene, sets.front()));
  for (const RaySet& set : sets) {
    for (const Way& way : ways) {
      records.push_back(measure_set(*accel.wide, set, way, options));
      records.back().scene = scene.name;
      fmt::print("{}", exactness_table({&records.back(), 1}));
      std::fflush(stdout);
    }
  }
  return records;
}

}  // namespace

int measure_exactness(const Options& given) {
  Options options = given;
  if (options.scenes.empty()) options.scenes = {"cow", "bunny"};
  std::vector<ExactnessRecord> records;
  fmt::print("{}\nmillion rays a second, one thread: medians\n", machine_line());
  for (const SceneEntry* entry : chosen_from(scene_entries(), options)) {
    const auto scene = make_scene(*entry, options.effort);
    if (!scene) continue;
    std::ranges::move(measure_scene(*scene, options), std::back_inserter(records));
  }
  if (records.empty()) return 1;
  fmt::print("{}", exactness_summary(records));
  write_json(options.folder / "exactness", records);
  return 0;
}

}  // namespace bench
