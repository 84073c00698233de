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
#include <vector>

#include "app/alarm.h"
#include "app/session_rates.h"
#include "app/session_tiles.h"
#include "app/shown_map.h"
#include "tracer/render/film_error.h"
#include "tracer/render/pass_schedule.h"
#include "tracer/render/render.h"

namespace app {

/// A picture to be traced.
struct PictureRequest {
  std::shared_ptr<const tracer::World> world;
  const tracer::Integrator* integrator = nullptr;
  tracer::RenderSettings settings;
  tracer::Vec2i size_px{1, 1};
};

/// When a picture is done.
struct RenderLimits {
  int samples = 0;   // of the noisiest pixels
  double error = 0;  // FilmError::upper_bound(); 0: the samples alone decide

  friend bool operator==(const RenderLimits&, const RenderLimits&) = default;
};

/// What the picture's error was estimated to be after so long.
struct ErrorPoint {
  double seconds = 0;  // of tracing
  tracer::FilmError error;
};

struct RenderStatus {
  bool is_rendering = false;
  bool is_picture_whole = false;  // each block of the coarsest pass is traced
  bool is_finished = false;       // a limit is reached
  uint32_t samples = 0;           // whole passes in the picture
  TraceRates rates;
  tracer::PassStats passes;        // of the picture together
  std::vector<ErrorPoint> errors;  // in the order of time
};

/// Traces on a thread of its own until a limit is reached, then sleeps. No call waits for rays.
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
  void set_limits(const RenderLimits& limits);
  /// What the tiles show from now on; all are queued anew.
  void show(ShownMap map);

  TileQueue::Taken take_tiles() { return tiles_.take(); }
  RenderStatus status();
  /// Whether every pixel has been traced once.
  bool has_samples();

 private:
  void run();
  void adopt_request(std::unique_lock<std::mutex>& lock);
  bool has_work() const;
  void trace_slice(std::unique_lock<std::mutex>& lock);
  void queue_all(std::unique_lock<std::mutex>& lock);
  void queue_tile(const tracer::Tile& tile, ShownMap map, uint64_t generation);

  std::function<void()> notify_;
  TileQueue tiles_;
  std::mutex mutex_;
  std::condition_variable changed_;
  tracer::StopFlag stop_;
  bool is_quitting_ = false;
  std::optional<PictureRequest> requested_;  // to be started
  PictureRequest current_;                   // in the film
  RenderLimits limits_;
  ShownMap map_ = ShownMap::picture;
  bool is_map_stale_ = false;  // tiles that were queued show something else, or are too old
  tracer::Pass pass_ = tracer::first_pass;
  std::vector<ErrorPoint> errors_;
  uint64_t generation_ = 0;  // of the film, grows with every clearing
  TraceRates rates_;
  tracer::PassStats passes_;  // into the film
  bool is_rendering_ = false;
  // The render thread's alone.
  std::unique_ptr<tracer::Film> film_;
  tracer::PassSchedule schedule_;
  double slice_seconds_ = 0;
  Alarm slice_end_;
  std::thread thread_;
};

}  // namespace app
