// SPDX-License-Identifier: MIT
#include "app/render_passes.h"

#include <algorithm>
#include <atomic>

#include "app/alarm.h"
#include "app/stopwatch.h"
#include "tracer/render/pass_schedule.h"

namespace app {
namespace {

// Samples, where neither their number nor a time nor an error is asked for; nullopt: no limit.
std::optional<int> sample_limit(const RenderOptions& options) {
  if (options.sample_count || options.seconds || options.error) return options.sample_count;
  return default_sample_count;
}

// Part of the whole job, from the samples, the time or the error that is asked for: whichever is
// nearest.
class RenderProgress {
 public:
  RenderProgress(const RenderOptions& options, tracer::Vec2i size_px, tracer::Progress& progress)
      : options_(options), tile_count_(tracer::make_tiles(size_px).size()), progress_(progress) {
    progress_.start_stage("rendering");
  }

  void start_pass(const tracer::Pass& pass) {
    sample_ = pass.sample;
    finished_tiles_ = 0;
  }
  void set_error(const tracer::FilmError& error) {
    error_fraction_ = std::min(1.0, *options_.error / error.upper_bound());
  }
  // From any worker thread.
  void finish_tile() {
    const double tiles = static_cast<double>(++finished_tiles_) / static_cast<double>(tile_count_);
    double fraction = error_fraction_;
    if (const std::optional<int> limit = sample_limit(options_)) {
      fraction = std::max(fraction, (sample_ + tiles) / *limit);
    }
    if (options_.seconds) fraction = std::max(fraction, stopwatch_.seconds() / *options_.seconds);
    progress_.set_fraction(fraction);
  }

 private:
  const RenderOptions& options_;
  size_t tile_count_;
  tracer::Progress& progress_;
  Stopwatch stopwatch_;
  uint32_t sample_ = 0;
  double error_fraction_ = 0;
  std::atomic<size_t> finished_tiles_ = 0;
};

}  // namespace

RenderedPasses render_passes(const tracer::World& world, const RenderOptions& options,
                             tracer::Film& film, tracer::StopFlag& stop,
                             tracer::Progress& progress) {
  RenderedPasses result;
  const Stopwatch stopwatch;
  Alarm deadline([&stop] { stop.request(); });
  if (options.seconds) deadline.set(*options.seconds);
  const std::optional<int> limit = sample_limit(options);
  RenderProgress shown(options, film.size_px(), progress);
  tracer::PassSchedule schedule(options.render);
  while (!limit || schedule.pass().sample < static_cast<uint32_t>(*limit)) {
    shown.start_pass(schedule.pass());
    const tracer::PassStats done =
        render_pass(world, *options.integrator, options.render, schedule.pass(), film, stop,
                    [&](const tracer::Tile&) { shown.finish_tile(); });
    result.passes.add(done);
    if (!done.is_complete) break;
    schedule.advance(film);
    result.whole_sample_count = schedule.pass().sample;
    if (!options.error || !schedule.is_estimate_due()) continue;
    result.error = estimate_error(film);
    if (result.error->upper_bound() <= *options.error) break;
    shown.set_error(*result.error);
  }
  result.seconds = stopwatch.seconds();
  return result;
}

}  // namespace app
