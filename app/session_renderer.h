// SPDX-License-Identifier: MIT
// The thread that traces pass after pass into a film.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "app/alarm.h"
#include "app/session_rates.h"
#include "app/session_tiles.h"
#include "tracer/render/render.h"

namespace app {

/// A picture to be traced.
struct PictureRequest {
  std::shared_ptr<const tracer::World> world;
  const tracer::Integrator* integrator = nullptr;
  tracer::RenderSettings settings;
  tracer::Vec2i size_px{1, 1};
};

struct RenderStatus {
  bool is_rendering = false;
  bool is_picture_whole = false;  // each block of the coarsest pass is traced
  uint32_t samples = 0;           // whole passes in the picture
  TraceRates rates;
  tracer::PassStats passes;  // of the picture together
};

/// Traces on a thread of its own until the sample limit is reached, then sleeps. No call waits for
/// rays.
class SessionRenderer {
 public:
  /// `notify` is called from any thread when there are new tiles or a new status.
  explicit SessionRenderer(std::function<void()> notify);
  ~SessionRenderer();
  SessionRenderer(const SessionRenderer&) = delete;
  SessionRenderer& operator=(const SessionRenderer&) = delete;

  /// A new picture: stops the pass in flight, clears the film, starts coarse.
  void restart(const PictureRequest& request);
  /// The same picture from an equal world with another tree: the pass in flight is stopped and
  /// resumed with it, the film is kept.
  void resume_with(std::shared_ptr<const tracer::World> world);
  void set_sample_limit(int sample_limit);

  TileQueue::Taken take_tiles() { return tiles_.take(); }
  RenderStatus status();

 private:
  void run();
  void adopt_request(std::unique_lock<std::mutex>& lock);
  bool has_work() const;
  void trace_slice(std::unique_lock<std::mutex>& lock);
  void queue_tile(const tracer::Tile& tile, uint64_t generation);

  std::function<void()> notify_;
  TileQueue tiles_;
  std::mutex mutex_;
  std::condition_variable changed_;
  tracer::StopFlag stop_;
  bool is_quitting_ = false;
  std::optional<PictureRequest> requested_;  // to be started
  PictureRequest current_;                   // in the film
  int sample_limit_ = 0;
  tracer::Pass pass_ = tracer::first_pass;
  uint64_t generation_ = 0;  // of the film, grows with every clearing
  TraceRates rates_;
  tracer::PassStats passes_;  // into the film
  bool is_rendering_ = false;
  std::unique_ptr<tracer::Film> film_;  // the render thread's alone, as is the next
  double slice_seconds_ = 0;
  Alarm slice_end_;
  std::thread thread_;
};

}  // namespace app
