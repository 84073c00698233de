// SPDX-License-Identifier: MIT
#include "app/session_renderer.h"

#include <atomic>
#include <chrono>
#include <utility>

#include "tracer/base/low_priority.h"
#include "tracer/base/parallel.h"

namespace app {
namespace {

// A pass is stopped and resumed about this often, so that rates are known long before a slow pass
// ends.
constexpr double least_slice_seconds = 0.25;

double now_seconds() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

TraceMode mode_of(const tracer::World& world) {
  return world.accel->has_tree() ? TraceMode::bvh : TraceMode::brute_force;
}

}  // namespace

SessionRenderer::SessionRenderer(std::function<void()> notify)
    : notify_(std::move(notify)),
      schedule_(tracer::RenderSettings{}),
      slice_seconds_(least_slice_seconds),
      slice_end_([this] { stop_.request(); }),
      thread_([this] { run(); }) {}

SessionRenderer::~SessionRenderer() {
  {
    const std::lock_guard lock(mutex_);
    is_quitting_ = true;
    stop_.request();
  }
  changed_.notify_one();
  thread_.join();
}

void SessionRenderer::restart(const PictureRequest& request) {
  {
    const std::lock_guard lock(mutex_);
    requested_ = request;
    // From here on tiles of the old picture are refused, though its pass may still be ending.
    tiles_.start_generation(++generation_, request.size_px);
    rates_ = {};
    passes_ = {};
    pass_ = tracer::first_pass;
    errors_.clear();
    stop_.request();
  }
  changed_.notify_one();
}

void SessionRenderer::resume_with(std::shared_ptr<const tracer::World> world) {
  {
    const std::lock_guard lock(mutex_);
    PictureRequest& picture = requested_ ? *requested_ : current_;
    if (picture.world && mode_of(*picture.world) != mode_of(*world)) rates_.forget_recent();
    picture.world = std::move(world);
    stop_.request();
  }
  changed_.notify_one();
}

void SessionRenderer::set_limits(const RenderLimits& limits) {
  {
    const std::lock_guard lock(mutex_);
    if (limits_ == limits) return;
    limits_ = limits;
    if (!has_work()) stop_.request();
  }
  changed_.notify_one();
}

void SessionRenderer::show(ShownMap map) {
  {
    const std::lock_guard lock(mutex_);
    if (map_ == map) return;
    map_ = map;
    is_map_stale_ = true;
    stop_.request();
  }
  changed_.notify_one();
}

RenderStatus SessionRenderer::status() {
  const std::lock_guard lock(mutex_);
  const bool is_picture_whole = pass_.sample > 0 || pass_.stride < tracer::first_pass.stride;
  const bool is_finished = current_.world && !requested_ && !has_work();
  return {is_rendering_, is_picture_whole, is_finished, pass_.sample, rates_, passes_, errors_};
}

bool SessionRenderer::has_samples() {
  const std::lock_guard lock(mutex_);
  return pass_.sample > 0;
}

bool SessionRenderer::has_work() const {
  const bool is_good_enough =
      limits_.error > 0 && !errors_.empty() && errors_.back().error.upper_bound() <= limits_.error;
  return current_.world && pass_.sample < static_cast<uint32_t>(limits_.samples) && !is_good_enough;
}

void SessionRenderer::run() {
  tracer::lower_priority(tracer::Priority::background);  // the window comes first
  std::unique_lock lock(mutex_);
  while (!is_quitting_) {
    if (requested_) {
      adopt_request(lock);
    } else if (is_map_stale_ && film_) {
      queue_all(lock);
    } else if (has_work()) {
      trace_slice(lock);
    } else {
      if (std::exchange(is_rendering_, false)) notify_();
      changed_.wait(lock, [this] {
        return is_quitting_ || requested_ || (is_map_stale_ && film_) || has_work();
      });
    }
  }
}

void SessionRenderer::adopt_request(std::unique_lock<std::mutex>& lock) {
  current_ = *std::exchange(requested_, std::nullopt);
  slice_seconds_ = least_slice_seconds;
  schedule_ = tracer::PassSchedule(current_.settings);
  const tracer::Vec2i size_px = current_.size_px;
  lock.unlock();  // a large film takes milliseconds to clear
  if (film_ && film_->size_px() == size_px) {
    film_->clear();
  } else {
    film_ = std::make_unique<tracer::Film>(size_px);
  }
  lock.lock();
}

void SessionRenderer::trace_slice(std::unique_lock<std::mutex>& lock) {
  is_rendering_ = true;
  stop_.reset();
  const PictureRequest picture = current_;
  const ShownMap map = map_;
  const uint64_t generation = generation_;
  lock.unlock();

  const double start = now_seconds();
  slice_end_.set(slice_seconds_);
  tracer::TileCallback on_tile;
  // Errors are told between passes: while one runs, the tiles beside are being added to.
  if (map != ShownMap::error) {
    on_tile = [&](const tracer::Tile& tile) { queue_tile(tile, map, generation); };
  }
  const tracer::PassStats stats =
      tracer::render_pass(*picture.world, *picture.integrator, picture.settings, schedule_.pass(),
                          *film_, stop_, on_tile);
  slice_end_.clear();
  const double end = now_seconds();
  const bool was_in_vain = stats.samples == 0 && end - start >= slice_seconds_;
  // A stopped pixel begins anew, so a slice has to be long enough for one.
  if (was_in_vain) slice_seconds_ *= 2;
  std::optional<tracer::FilmError> error;
  if (stats.is_complete) {
    slice_seconds_ = least_slice_seconds;
    schedule_.advance(*film_);
    if (schedule_.is_estimate_due()) error = estimate_error(*film_);
  }

  lock.lock();
  if (generation != generation_) return;
  const TraceMode mode = mode_of(*picture.world);
  rates_.add(mode, stats.rays, end - start, end);
  passes_.add(stats);
  if (mode != mode_of(*current_.world)) rates_.forget_recent();
  pass_ = schedule_.pass();
  if (error) errors_.push_back({rates_.seconds(), *error});
  if (error && map_ == ShownMap::error) is_map_stale_ = true;
  notify_();
}

void SessionRenderer::queue_all(std::unique_lock<std::mutex>& lock) {
  is_map_stale_ = false;
  const ShownMap map = map_;
  const uint64_t generation = generation_;
  lock.unlock();
  const std::vector<tracer::Tile> tiles = tracer::make_tiles(film_->size_px());
  tracer::parallel_for_each_index(0, tiles.size(),
                                  [&](size_t tile) { queue_tile(tiles[tile], map, generation); });
  lock.lock();
}

void SessionRenderer::queue_tile(const tracer::Tile& tile, ShownMap map, uint64_t generation) {
  tiles_.push(generation, {tile, shown_pixels(*film_, tile, map, schedule_.pass().sample)});
  notify_();
}

}  // namespace app
