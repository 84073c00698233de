// SPDX-License-Identifier: MIT
#include "app/render_passes.h"

#include <atomic>

#include "app/alarm.h"
#include "app/stopwatch.h"

namespace app {
namespace {

// Part of the whole job, from the samples or the time that is asked for.
class RenderProgress {
 public:
  RenderProgress(const RenderOptions& options, tracer::Vec2i size_px, tracer::Progress& progress)
      : options_(options),
        sample_count_(options.sample_count.value_or(default_sample_count)),
        tile_count_(tracer::make_tiles(size_px).size()),
        progress_(progress) {
    progress_.start_stage("rendering");
  }

  void start_pass(const tracer::Pass& pass) {
    sample_ = pass.sample;
    finished_tiles_ = 0;
  }
  // From any worker thread.
  void finish_tile() {
    const double tiles = static_cast<double>(++finished_tiles_) / static_cast<double>(tile_count_);
    progress_.set_fraction(options_.seconds ? stopwatch_.seconds() / *options_.seconds
                                            : (sample_ + tiles) / sample_count_);
  }

 private:
  const RenderOptions& options_;
  int sample_count_;
  size_t tile_count_;
  tracer::Progress& progress_;
  Stopwatch stopwatch_;
  uint32_t sample_ = 0;
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
  const auto limit = static_cast<uint32_t>(options.sample_count.value_or(default_sample_count));
  RenderProgress shown(options, film.size_px(), progress);
  for (tracer::Pass pass = tracer::first_pass; options.seconds || pass.sample < limit;
       pass = next_pass(pass)) {
    shown.start_pass(pass);
    const tracer::PassStats done =
        render_pass(world, *options.integrator, options.render, pass, film, stop,
                    [&](const tracer::Tile&) { shown.finish_tile(); });
    result.passes.add(done);
    if (!done.is_complete) break;
    if (pass.stride == 1) result.whole_sample_count = pass.sample + 1;
  }
  result.seconds = stopwatch.seconds();
  return result;
}

}  // namespace app
