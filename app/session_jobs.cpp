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

// `metrics` are those of the tree that was laid out.
void put(BuiltTree& built, BuiltAccel made, tracer::TreeMetrics metrics) {
  built.accel = std::move(made.accel);
  built.tree = std::move(made.tree);
  built.held_tree = built.tree;
  if (!built.tree) return;
  built.metrics = std::move(metrics);
  built.measurement = std::make_shared<QualityMeasurement>(
      QualityMeasurement{built.accel->mesh, built.tree, built.metrics.costs});
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
  auto metrics = made.tree ? measure(*made.tree, sah_costs(key.settings)) : tracer::TreeMetrics{};
  put(built, std::move(made), std::move(metrics));
  built.improvement.first_sah_cost = built.metrics.sah_cost;
  progress.throw_if_stopped();
  return built;
}

BuiltTree improve_tree(const BuiltTree& built, tracer::Progress& progress) {
  constexpr double least_gain = 0.001;
  BuiltTree improved = built;
  tracer::run_at_low_priority([&] {
    progress.start_stage("improving the tree");
    tracer::BvhTree tree = reinsert(*built.tree, built.key.settings, progress);
    tracer::TreeMetrics metrics = measure(tree, built.metrics.costs);
    improved.improvement.is_over = !(metrics.sah_cost < (1 - least_gain) * built.metrics.sah_cost);
    if (improved.improvement.is_over) return;
    put(improved, lay_out(built.accel->mesh, std::move(tree), *built.key.layout, progress),
        std::move(metrics));
    ++improved.improvement.rounds;
  });
  return improved;
}

}  // namespace app
