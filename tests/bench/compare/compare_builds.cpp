// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "app/stopwatch.h"
#include "tests/bench/compare/build_records.h"
#include "tests/bench/compare/choose.h"
#include "tests/bench/compare/commands.h"
#include "tests/bench/compare/embree_scene.h"
#include "tests/bench/compare/machine.h"
#include "tests/bench/compare/pinned_threads.h"
#include "tests/bench/compare/report_files.h"
#include "tracer/base/parallel.h"
#include "tracer/bvh/build.h"
#include "tracer/bvh/metrics.h"
#include "tracer/bvh/trace/accel.h"

namespace bench {
namespace {

using tracer::Mesh;

/// One build, timed.
struct BuildRun {
  double ms = 0;
  double tree_ms = 0;
  double layout_ms = 0;
  double sah = 0;
  size_t bytes = 0;
  size_t tree_bytes = 0;
};

struct Contestant {
  std::string name;
  std::function<BuildRun(const Scene& scene)> build;
};

BuildRun build_ours(const tracer::Builder& builder, const Scene& scene) {
  tracer::Progress progress;
  const app::Stopwatch stopwatch;
  const auto boxes = primitive_boxes(*scene.mesh);
  const auto tree = std::make_shared<const tracer::BvhTree>(
      builder.build(mesh_primitives(*scene.mesh, boxes), {}, progress));
  const double tree_ms = 1000 * stopwatch.seconds();
  const tracer::Accel accel = make_accel(scene.mesh, tree, tracer::layouts().front(), progress);
  const double ms = 1000 * stopwatch.seconds();
  return {ms, tree_ms, ms - tree_ms, measure(*tree).sah_cost, accel.bytes(), tree->bytes()};
}

#ifdef BOXWOOD_EMBREE
BuildRun build_embree(RTCBuildQuality quality, const Scene& scene) {
  EmbreeScene embree(*scene.mesh, quality, EmbreeMode::standard);
  const app::Stopwatch stopwatch;
  embree.build();
  BuildRun run;
  run.ms = 1000 * stopwatch.seconds();
  run.bytes = static_cast<size_t>(embree.bytes());
  return run;
}
#endif

constexpr const char* embree_medium = "embree MEDIUM";

std::vector<Contestant> contestants() {
  std::vector<Contestant> all;
  for (const tracer::Builder& builder : tracer::builders()) {
    all.push_back({std::string(builder.name),
                   [&builder](const Scene& scene) { return build_ours(builder, scene); }});
  }
#ifdef BOXWOOD_EMBREE
  for (const auto& [name, quality] : {std::pair{"embree LOW", RTC_BUILD_QUALITY_LOW},
                                      std::pair{embree_medium, RTC_BUILD_QUALITY_MEDIUM},
                                      std::pair{"embree HIGH", RTC_BUILD_QUALITY_HIGH}}) {
    all.push_back({name, [quality](const Scene& scene) { return build_embree(quality, scene); }});
  }
#endif
  return all;
}

std::vector<double> times_of(const std::vector<BuildRun>& runs, double BuildRun::*part) {
  std::vector<double> times;
  for (const BuildRun& run : runs) times.push_back(run.*part);
  return times;
}

BuildRecord make_record(const Scene& scene, const std::string& builder,
                        const std::vector<BuildRun>& runs) {
  BuildRecord record;
  record.scene = scene.name;
  record.builder = builder;
  record.ms = spread_of(times_of(runs, &BuildRun::ms));
  record.tree_ms = spread_of(times_of(runs, &BuildRun::tree_ms));
  record.layout_ms = spread_of(times_of(runs, &BuildRun::layout_ms));
  record.sah = runs.front().sah;
  record.bytes = runs.front().bytes;
  record.tree_bytes = runs.front().tree_bytes;
  record.triangles = scene.mesh->triangle_count();
  return record;
}

// Round by round, so that noise meets all of them. Each builder is timed right after an untimed run
// of its own: whose freed memory it finds, or has to ask the system for, depends on no other.
std::vector<BuildRecord> compare_scene(const Scene& scene, int repeat_count) {
  const std::vector<Contestant> all = contestants();
  std::vector<std::vector<BuildRun>> runs(all.size());
  for (int round = 0; round < repeat_count; ++round) {
    for (size_t i = 0; i < all.size(); ++i) {
      all[i].build(scene);
      runs[i].push_back(all[i].build(scene));
    }
  }
  const auto medium = std::ranges::find(all, embree_medium, &Contestant::name);
  std::vector<BuildRecord> records;
  for (size_t i = 0; i < all.size(); ++i) {
    records.push_back(make_record(scene, all[i].name, runs[i]));
    if (medium == all.end()) continue;
    const auto& reference = runs[static_cast<size_t>(medium - all.begin())];
    records.back().ratio =
        paired_ratio(times_of(runs[i], &BuildRun::ms), times_of(reference, &BuildRun::ms));
  }
  return records;
}

}  // namespace

int compare_builds(const Options& options) {
  std::vector<BuildRecord> records;
  const std::string machine = machine_line();
  const int most_threads = std::min(2, processor_count());
  fmt::print("{}\n", machine);
  for (const SceneEntry* entry : chosen_from(scene_entries(), options)) {
    const auto scene = make_scene(*entry, options.effort);
    if (!scene) continue;
    for (int thread_count = 1; thread_count <= most_threads; ++thread_count) {
      std::vector<BuildRecord> measured = tracer::with_thread_count(
          thread_count, [&] { return compare_scene(*scene, options.repeat_count); });
      for (BuildRecord& record : measured) record.threads = thread_count;
      fmt::print("{}", build_table(measured));
      std::fflush(stdout);
      records.insert(records.end(), measured.begin(), measured.end());
    }
  }
  if (records.empty()) return 1;
  write_report(options.folder / "build", records, build_chart(records, most_threads, machine));
  return 0;
}

}  // namespace bench
