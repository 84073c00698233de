// SPDX-License-Identifier: MIT
// What a user waits for: the first picture of a model, and the answer to a moved camera.
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <benchmark/benchmark.h>

#include "app/session.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr tracer::Vec2i size_px{1280, 720};

/// A session with the part of the window: adopts models and waits for pictures.
class Viewer {
 public:
  Viewer() : session_([this] { wake(); }) {
    edits_.size_px = size_px;
    edits_.sky = tracer::Vec3d(0.5);
    edits_.builder = &tracer::builders().front();
    edits_.integrator = tracer::find_integrator("eyelight");
  }

  /// Loads and waits for the model alone.
  bool open(const std::string& path) {
    session_.set(edits_);
    session_.open(path);
    do {
      wait();
      if (!status_.error.empty()) return false;
    } while (status_.model_generation == edits_.model_generation);
    const tracer::Mesh& mesh = *status_.model->scene.mesh;
    edits_.camera = default_camera(mesh.bounds, mesh.origin, 16.0 / 9);
    edits_.model_generation = status_.model_generation;
    return true;
  }

  void orbit() {
    edits_.camera.eye += 0.01 * (edits_.camera.target - edits_.camera.eye);
    session_.poll();
  }

  enum class Part { first_tile, whole_picture };

  /// Seconds from the edit to the first tile, or to a coarse picture of every pixel.
  double show(Part part) {
    const auto start = Clock::now();
    session_.set(edits_);
    int64_t missing = part == Part::first_tile ? 1 : int64_t{size_px.x} * size_px.y;
    while (missing > 0) {
      for (const FinishedTile& finished : wait()) {
        missing -= int64_t{finished.tile.width()} * finished.tile.height();
      }
    }
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

 private:
  void wake() {
    const std::lock_guard lock(mutex_);
    has_news_ = true;
    news_.notify_one();
  }

  std::vector<FinishedTile> wait() {
    {
      std::unique_lock lock(mutex_);
      news_.wait_for(lock, std::chrono::milliseconds(20), [this] { return has_news_; });
      has_news_ = false;
    }
    Update update = session_.poll();
    status_ = update.status;
    return std::move(update.tiles);
  }

  std::mutex mutex_;
  std::condition_variable news_;
  bool has_news_ = false;
  Edits edits_;
  Status status_;
  Session session_;
};

void bench_first_picture(benchmark::State& state, const std::string& path) {
  for (auto _ : state) {
    Viewer viewer;
    if (!viewer.open(path)) return state.SkipWithError("the model could not be loaded");
    state.SetIterationTime(viewer.show(Viewer::Part::whole_picture));
  }
}

void bench_orbit(benchmark::State& state, const std::string& path, Viewer::Part part) {
  Viewer viewer;
  if (!viewer.open(path)) return state.SkipWithError("the model could not be loaded");
  viewer.show(Viewer::Part::whole_picture);
  for (auto _ : state) {
    viewer.orbit();
    state.SetIterationTime(viewer.show(part));
  }
}

// From the request to the end of a pass that traces brute force.
void bench_stop(benchmark::State& state, const std::string& path) {
  tracer::Progress progress;
  auto scene = std::make_shared<tracer::Scene>(tracer::import_obj(path, progress).scene);
  const tracer::Mesh& mesh = *scene->mesh;
  const tracer::World world{
      scene, std::make_shared<tracer::Accel>(tracer::Accel{scene->mesh}),
      make_camera_frame(default_camera(mesh.bounds, mesh.origin, 16.0 / 9), size_px, mesh.origin)};
  for (auto _ : state) {
    tracer::Film film(size_px);
    tracer::StopFlag stop;
    std::thread renderer([&] {
      tracer::render_pass(world, tracer::integrators().front(), {}, {0, 1}, film, stop);
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const auto start = Clock::now();
    stop.request();
    renderer.join();
    state.SetIterationTime(std::chrono::duration<double>(Clock::now() - start).count());
  }
}

void register_benchmark(const std::string& name,
                        const std::function<void(benchmark::State&)>& function) {
  benchmark::RegisterBenchmark(name.c_str(), function)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond)
      ->Iterations(30);
}

const bool is_registered = [] {
  for (const std::string model : {"cow", "stanford-bunny"}) {
    const std::string path = BOXWOOD_SHARED_DIR "/models/" + model + ".obj";
    register_benchmark("first_picture/" + model,
                       [path](benchmark::State& state) { bench_first_picture(state, path); });
    register_benchmark("stop_brute_force/" + model,
                       [path](benchmark::State& state) { bench_stop(state, path); });
    register_benchmark("orbit_to_first_tile/" + model, [path](benchmark::State& state) {
      bench_orbit(state, path, Viewer::Part::first_tile);
    });
    register_benchmark("orbit_to_whole_picture/" + model, [path](benchmark::State& state) {
      bench_orbit(state, path, Viewer::Part::whole_picture);
    });
  }
  return true;
}();

}  // namespace
}  // namespace app
