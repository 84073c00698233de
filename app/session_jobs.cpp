// SPDX-License-Identifier: MIT
#include "app/session_jobs.h"

#include <chrono>
#include <utility>

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
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
  BuiltTree built{.key = key, .accel = nullptr, .metrics = {}, .seconds = 0};
  const auto start = Clock::now();
  built.accel = build_accel(mesh, key, progress);
  if (built.accel->tree) {
    built.seconds = seconds_since(start);
    built.metrics = measure(*built.accel, sah_costs(key.settings));
  }
  progress.throw_if_stopped();
  return built;
}

}  // namespace app
