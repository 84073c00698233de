// SPDX-License-Identifier: MIT
// Edits in, finished tiles out. Knows no window and no OpenGL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/environment_source.h"
#include "app/session_renderer.h"
#include "app/session_tiles.h"
#include "tracer/bvh/build.h"
#include "tracer/bvh/quality.h"
#include "tracer/render/render.h"
#include "tracer/scene/import_obj.h"

namespace app {

/// Everything the user may set. for_each_field lists of BuildSettings and RenderSettings say what
/// each change costs.
struct Edits {
  /// Status::model_generation of the model that these edits, the camera above all, are meant for.
  /// A newer model is not traced until they are.
  uint64_t model_generation = 0;
  tracer::Camera camera;
  tracer::Vec2i size_px{1, 1};
  tracer::Vec3d sky{1.0};
  LoadedEnvironment environment{};  // instead of `sky`, where there is one
  tracer::Shading shading = tracer::Shading::flat;
  const tracer::Integrator* integrator = nullptr;  // nullptr: the first of the table
  tracer::RenderSettings render;
  const tracer::Builder* builder = &tracer::builders().front();  // nullptr: BVH off, brute force
  const tracer::Layout* layout = &tracer::layouts().front();
  tracer::BuildSettings build;
  bool improve = true;  // the tree by re-insertion, while and after the picture resolves
  int sample_limit = 1024;
  double error_limit = 0;  // relMSE at which the picture is done; 0: the samples alone decide
  ShownMap shown = ShownMap::picture;  // of the picture, in its tiles
};

/// What the program is doing and did, for the panel.
struct Status {
  bool is_loading = false;
  bool is_building = false;
  bool is_rendering = false;
  bool is_answered = false;       // the edits' tree is in use, and all of the picture shows them
  bool is_improving = false;      // the tree in use, in the background
  std::string stage;              // of the job that runs
  float fraction = 0;             // of the stage
  std::string loading_path;       // while is_loading
  std::string error;              // of the last load, empty when it went well
  uint64_t error_generation = 0;  // grows with every error, equal ones too
  std::string model_path;         // empty: none yet
  uint64_t model_generation = 0;  // grows with every model that replaces another
  std::shared_ptr<const tracer::ImportedScene> model;
  const tracer::Builder* builder = nullptr;  // of the tree in use; nullptr when the BVH is off
  tracer::TreeMetrics tree;                  // of the same tree; nodes 0 when there is none
  std::optional<tracer::TreeQuality> tree_quality;  // of the same tree, when it is known
  // Held for the tree in use, beside the mesh: what is traced, and until it is improved and
  // measured the binary tree that it was made of.
  size_t tree_bytes = 0;
  int improvement_rounds = 0;  // of re-insertion that the tree in use has gained by
  double first_sah_cost = 0;   // of the tree in use, as it was built
  double load_seconds = 0;
  double build_seconds = 0;
  double mrays_per_second = 0;              // of the last second of tracing
  double mrays_per_second_bvh = 0;          // of this picture's rays, with the tree
  double mrays_per_second_brute_force = 0;  // and without; 0 until known
  bool is_finished = false;                 // the picture has reached a limit
  uint32_t samples = 0;                     // whole passes in the picture
  double mean_samples = 0;                  // of its pixels
  std::vector<ErrorPoint> errors;           // of this picture, in the order of time
  uint64_t rays = 0;                        // traced for this picture
  double seconds = 0;                       // spent tracing this picture
  uint64_t dropped_samples = 0;             // of this picture: not finite, so counted as black
  std::string replay;                       // the command that shows the first of them
};

struct Update {
  tracer::Vec2i size_px{0, 0};  // of the picture the tiles belong to
  std::vector<FinishedTile> tiles;
  Status status;
};

/// Loads, builds and renders on threads of its own; no call here waits for any of that.
class Session {
 public:
  /// `wake` is called from any thread when poll() has news, at most once between two polls.
  explicit Session(std::function<void()> wake);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Starts loading; what is shown stays until the new model is ready, and for good if it fails.
  void open(const std::filesystem::path& path);
  /// Ends a load or build in flight; what was shown before stays. A cancelled build is not begun
  /// again until the settings change.
  void cancel_job();
  /// The user's settings as they now are. Works out what must be done again, and does no more.
  void set(const Edits& edits);

  /// What is new since the last call.
  Update poll();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace app
