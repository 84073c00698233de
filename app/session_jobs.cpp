// SPDX-License-Identifier: MIT
#include "app/session_jobs.h"

#include <chrono>
#include <utility>

#include "tracer/base/low_priority.h"
#include "tracer/bvh/build/reinsertion.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void put(BuiltTree& built, BuiltAccel made) {
  built.accel = std::move(made.accel);
  built.tree = std::move(made.tree);
  built.held_tree = built.tree;
  if (!built.tree) return;
  built.metrics = measure(*built.tree, sah_costs(built.key.settings));
  built.measurement =
      std::make_shared<QualityMeasurement>(QualityMeasurement{built.accel->mesh, built.tree});
}

}  // namespace

LoadedModel load_model(const std::filesystem::path& path, tracer::Progress& progress) {
  const auto start = Clock::now();
  LoadedModel model;
  model.path = path.string();
  model.imported =
      std::make_shared<const tracer::ImportedScene>(tracer::import_obj(path, progress));
  model.scene = std::make_shared<const tracer::Scene>(model.imported->scene);
  model.seconds = seconds_since(start);
  return model;
}

BuiltTree build_tree(const std::shared_ptr<const tracer::Mesh>& mesh, const TreeKey& key,
                     tracer::Progress& progress) {
  BuiltTree built;
  built.key = key;
  const auto start = Clock::now();
  BuiltAccel made = build_accel(mesh, key, progress);
  if (made.tree) built.seconds = seconds_since(start);
  put(built, std::move(made));
  built.improvement.first_sah_cost = built.metrics.sah_cost;
  progress.throw_if_stopped();
  return built;
}

BuiltTree improve_tree(const BuiltTree& built, tracer::Progress& progress) {
  constexpr double least_gain = 0.001;
  const tracer::SahCosts costs = sah_costs(built.key.settings);
  BuiltTree improved = built;
  tracer::run_at_low_priority([&] {
    progress.start_stage("improving the tree");
    tracer::BvhTree tree = reinsert(*built.tree, built.key.settings, progress);
    improved.improvement.is_over =
        !(measure(tree, costs).sah_cost < (1 - least_gain) * built.metrics.sah_cost);
    if (improved.improvement.is_over) return;
    put(improved, lay_out(built.accel->mesh, std::move(tree), *built.key.layout, progress));
    ++improved.improvement.rounds;
  });
  return improved;
}

}  // namespace app
