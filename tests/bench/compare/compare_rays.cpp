// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "tests/bench/compare/choose.h"
#include "tests/bench/compare/commands.h"
#include "tests/bench/compare/embree_scene.h"
#include "tests/bench/compare/machine.h"
#include "tests/bench/compare/oracle.h"
#include "tests/bench/compare/pinned_threads.h"
#include "tests/bench/compare/ray_records.h"
#include "tests/bench/compare/ray_runners.h"
#include "tests/bench/compare/report_files.h"
#include "tests/bench/compare/tracers.h"
#include "tracer/bvh/build.h"

namespace bench {
namespace {

using tracer::Accel;

/// Trees and tracers of one scene.
struct Contest {
  std::vector<std::unique_ptr<const Accel>> accels;  // the default builder's first
#ifdef BOXWOOD_EMBREE
  std::unique_ptr<EmbreeScene> standard, robust;
#endif
  std::vector<Tracer> tracers;  // Boxwood's single rays first
};

Contest make_contest(const Scene& scene, BuilderChoice choice) {
  Contest contest;
  for (const tracer::Builder& builder : tracer::builders()) {
    const bool is_default = contest.accels.empty();
    if (!is_default && choice == BuilderChoice::standard) break;
    tracer::Progress progress;
    const auto boxes = primitive_boxes(*scene.mesh);
    contest.accels.push_back(std::make_unique<const Accel>(
        make_accel(scene.mesh, builder.build(mesh_primitives(*scene.mesh, boxes), {}, progress),
                   tracer::layouts().front(), progress)));
    const std::string suffix = is_default ? "" : fmt::format(" {}", builder.name);
    std::ranges::move(boxwood_tracers(*contest.accels.back(), suffix),
                      std::back_inserter(contest.tracers));
  }
#ifdef BOXWOOD_EMBREE
  const auto build = [&](EmbreeMode mode) {
    auto embree = std::make_unique<EmbreeScene>(*scene.mesh, RTC_BUILD_QUALITY_MEDIUM, mode);
    embree->build();
    return embree;
  };
  contest.standard = build(EmbreeMode::standard);
  contest.robust = build(EmbreeMode::robust);
  std::ranges::move(embree_tracers(*contest.standard, *contest.robust),
                    std::back_inserter(contest.tracers));
#endif
  return contest;
}

RayRecord make_record(const Runner& runner, const std::vector<Runner>& runners) {
  RayRecord record;
  record.tracer = runner.tracer->name;
  record.ray_count = runner.answers.size();
  std::vector<double> speeds;
  for (const double seconds : runner.seconds) {
    speeds.push_back(static_cast<double>(record.ray_count) / 1e6 / seconds);
  }
  record.mrays_per_second = spread_of(std::move(speeds));
  for (const Runner& other : runners) {
    if (other.tracer->is_ours()) continue;
    record.ratios[other.tracer->name] = paired_ratio(other.seconds, runner.seconds);
  }
  return record;
}

std::vector<RayRecord> compare_set(const Scene& scene, const Contest& contest, const RaySet& all,
                                   const Options& options) {
  std::vector<RayRecord> records;
  if (all.rays.empty()) return records;
  const RaySet set = fitted(all, contest.tracers, options.seconds_a_run);
  std::vector<Runner> runners = make_runners(contest.tracers, set);
  const OracleVerdict verdict = ask_oracle(*contest.accels.front(), set);
  for (int thread_count = 1; thread_count <= std::min(2, processor_count()); ++thread_count) {
    time_rounds(runners, thread_count, options.repeat_count);
    for (const Runner& runner : runners) {
      RayRecord record = make_record(runner, runners);
      record.scene = scene.name;
      record.rays = set.kind->name;
      record.threads = thread_count;
      record.disagreements = count_differences(runner, runners.front());
      if (runner.tracer->is_ours()) {
        record.disagreements += verdict.disagreements;
        record.oracle_rays = verdict.ray_count;
      }
      records.push_back(std::move(record));
    }
  }
  return records;
}

bool is_wrong(const RayRecord& record) {
  return record.oracle_rays > 0 && record.disagreements > 0;
}

}  // namespace

int compare_rays(const Options& options) {
  std::vector<RayRecord> records;
  const std::string machine = machine_line();
  fmt::print("{}\nmillion rays a second: median (min - max)\n", machine);
  for (const SceneEntry* entry : chosen_from(scene_entries(), options)) {
    const auto scene = make_scene(*entry, options.effort);
    if (!scene) continue;
    const Contest contest = make_contest(*scene, options.builders);
    const int side_px = options.effort == Effort::quick ? 256 : 1024;
    for (const RaySet& set : make_ray_sets(*scene, *contest.accels.front(), side_px)) {
      const std::vector<RayRecord> measured = compare_set(*scene, contest, set, options);
      fmt::print("{}", ray_table(measured));
      std::fflush(stdout);
      records.insert(records.end(), measured.begin(), measured.end());
    }
  }
  if (records.empty()) return 1;
  fmt::print("\ngeometric means of the ratios over all scenes\n{}", ratio_table(records));
  write_report(options.folder / "rays", records, ray_chart(records, machine));
  return std::ranges::any_of(records, is_wrong) ? 1 : 0;
}

}  // namespace bench
