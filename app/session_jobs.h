// SPDX-License-Identifier: MIT
// What the session's job thread does, as functions of their arguments alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "app/build_accel.h"
#include "app/session_quality.h"
#include "tracer/base/progress.h"
#include "tracer/bvh/build.h"
#include "tracer/bvh/metrics.h"
#include "tracer/bvh/trace/accel.h"
#include "tracer/scene/import_obj.h"

namespace app {

/// What re-insertion has done for a tree.
struct Improvement {
  int rounds = 0;
  double first_sah_cost = 0;  // as it was built
  bool is_over = false;       // another round would gain too little
};

struct BuiltTree {
  TreeKey key;
  std::shared_ptr<const tracer::Accel> accel;
  // What the accel was made of, as long as it may be improved; nullptr without a builder.
  std::shared_ptr<const tracer::BvhTree> tree;
  std::shared_ptr<QualityMeasurement> measurement;
  std::weak_ptr<const tracer::BvhTree> held_tree;  // by anybody
  tracer::TreeMetrics metrics;
  double seconds = 0;
  Improvement improvement{};

  bool may_improve() const { return tree && !improvement.is_over; }
  /// That are held because of it at present, beside the mesh.
  size_t bytes() const {
    const bool is_held_beside = !held_tree.expired() && !accel->tree;
    return accel->bytes() + (is_held_beside ? metrics.bytes : 0);
  }
};

struct LoadedModel {
  std::string path;
  uint64_t generation = 0;
  std::shared_ptr<const tracer::ImportedScene> imported;
  std::shared_ptr<const tracer::Scene> scene;  // shaded as wanted
  double seconds = 0;
};

/// Throws LoadError or Cancelled.
LoadedModel load_model(const std::filesystem::path& path, tracer::Progress& progress);
/// Throws Cancelled.
BuiltTree build_tree(const std::shared_ptr<const tracer::Mesh>& mesh, const TreeKey& key,
                     tracer::Progress& progress);
/// One round of re-insertion, at low priority; the same tree where that would not lower its cost by
/// a thousandth. Throws Cancelled.
BuiltTree improve_tree(const BuiltTree& built, tracer::Progress& progress);

}  // namespace app
