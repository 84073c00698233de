// SPDX-License-Identifier: MIT
#include "app/session_renderer.h"

#include <atomic>
#include <chrono>
#include <utility>

#include "tracer/base/low_priority.h"

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

void SessionRenderer::set_sample_limit(int sample_limit) {
  {
    const std::lock_guard lock(mutex_);
    if (sample_limit_ == sample_limit) return;
    sample_limit_ = sample_limit;
    if (!has_work()) stop_.request();
  }
  changed_.notify_one();
}

RenderStatus SessionRenderer::status() {
  const std::lock_guard lock(mutex_);
  const bool is_picture_whole = pass_.sample > 0 || pass_.stride < tracer::first_pass.stride;
  return {is_rendering_, is_picture_whole, pass_.sample, rates_, passes_};
}

bool SessionRenderer::has_work() const {
  return current_.world && pass_.sample < static_cast<uint32_t>(sample_limit_);
}

void SessionRenderer::run() {
  tracer::lower_priority(tracer::Priority::background);  // the window comes first
  std::unique_lock lock(mutex_);
  while (!is_quitting_) {
    if (requested_) {
      adopt_request(lock);
    } else if (has_work()) {
      trace_slice(lock);
    } else {
      if (std::exchange(is_rendering_, false)) notify_();
      changed_.wait(lock, [this] { return is_quitting_ || requested_ || has_work(); });
    }
  }
}

void SessionRenderer::adopt_request(std::unique_lock<std::mutex>& lock) {
  current_ = *std::exchange(requested_, std::nullopt);
  slice_seconds_ = least_slice_seconds;
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
  const tracer::Pass pass = pass_;
  const uint64_t generation = generation_;
  lock.unlock();

  const double start = now_seconds();
  slice_end_.set(slice_seconds_);
  const auto on_tile = [&](const tracer::Tile& tile) { queue_tile(tile, generation); };
  const tracer::PassStats stats = tracer::render_pass(
      *picture.world, *picture.integrator, picture.settings, pass, *film_, stop_, on_tile);
  slice_end_.clear();
  const double end = now_seconds();
  const bool was_in_vain = stats.samples == 0 && end - start >= slice_seconds_;
  // A stopped pixel begins anew, so a slice has to be long enough for one.
  if (was_in_vain) slice_seconds_ *= 2;
  if (stats.is_complete) slice_seconds_ = least_slice_seconds;

  lock.lock();
  if (generation != generation_) return;
  const TraceMode mode = mode_of(*picture.world);
  rates_.add(mode, stats.rays, end - start, end);
  passes_.add(stats);
  if (mode != mode_of(*current_.world)) rates_.forget_recent();
  if (stats.is_complete) pass_ = tracer::next_pass(pass);
  notify_();
}

void SessionRenderer::queue_tile(const tracer::Tile& tile, uint64_t generation) {
  FinishedTile finished{tile, {}};
  finished.pixels.reserve(static_cast<size_t>(tile.width()) * tile.height());
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) finished.pixels.push_back(film_->mean(x, y));
  }
  tiles_.push(generation, std::move(finished));
  notify_();
}

}  // namespace app
