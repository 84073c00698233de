// SPDX-License-Identifier: MIT
#include "app/session_jobs.h"

#include <chrono>
#include <utility>

#include "app/session_changes.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

bool is_same_tree(const TreeKey& a, const TreeKey& b) {
  if (a.builder != b.builder) return false;
  return a.builder == nullptr || !differs(a.settings, b.settings, tracer::Effect::rebuild);
}

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
  auto accel = std::make_shared<tracer::Accel>();
  accel->mesh = mesh;
  if (key.builder != nullptr) {
    progress.start_stage("building the tree");
    const auto start = Clock::now();
    accel->tree = key.builder->build(primitive_boxes(*mesh), key.settings, progress);
    built.seconds = seconds_since(start);
    built.metrics = measure(*accel->tree);
  }
  progress.throw_if_stopped();
  built.accel = std::move(accel);
  return built;
}

}  // namespace app
