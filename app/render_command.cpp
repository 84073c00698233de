// SPDX-License-Identifier: MIT
#include "app/render_command.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>

#include <fmt/format.h>
#include <unistd.h>

#include "app/build_accel.h"
#include "app/exit_code.h"
#include "app/interrupt.h"
#include "app/option_error.h"
#include "app/print_warnings.h"
#include "app/progress_bar.h"
#include "app/render_passes.h"
#include "app/render_report.h"
#include "app/render_view.h"
#include "app/replay.h"
#include "app/stopwatch.h"
#include "tracer/base/parallel.h"
#include "tracer/base/write_file.h"
#include "tracer/render/write_image.h"

namespace app {
namespace {

void check_pixel(tracer::Vec2i pixel, tracer::Vec2i size_px) {
  if (pixel.x < size_px.x && pixel.y < size_px.y) return;
  throw OptionError(fmt::format("--pixel: {},{} lies outside; the last pixel of {}x{} is {},{}",
                                pixel.x, pixel.y, size_px.x, size_px.y, size_px.x - 1,
                                size_px.y - 1));
}

// They are written in place, so that they can go to /dev/stdout and the like.
void check_stats_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const bool is_new = !std::filesystem::exists(path, ignored);
  if (is_new || std::filesystem::is_directory(path, ignored)) return tracer::check_writable(path);
  if (access(path.c_str(), W_OK) != 0) {
    throw tracer::LoadError(
        {path.string(), 0, std::string("cannot write: ") + std::strerror(errno)});
  }
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;
  return std::filesystem::weakly_canonical(std::filesystem::absolute(a), ignored) ==
         std::filesystem::weakly_canonical(std::filesystem::absolute(b), ignored);
}

// Hours of work should not end at a misspelt folder.
void check_outputs(const RenderOptions& options) {
  if (options.output) tracer::check_writable(*options.output);
  if (!options.aovs.empty() && !tracer::can_hold_layers(*options.output)) {
    throw OptionError(
        fmt::format("--aov: {} cannot hold layers; write an EXR: -o {}", options.output->string(),
                    std::filesystem::path(*options.output).replace_extension(".exr").string()));
  }
  if (!options.stats_file) return;
  check_stats_file(*options.stats_file);
  if (options.output && is_same_file(*options.output, *options.stats_file)) {
    throw OptionError("-o and --stats name the same file; give each its own");
  }
}

class RenderJob {
 public:
  explicit RenderJob(const RenderOptions& options)
      : options_(options), interrupt_(progress_, stop_) {
    if (!options.is_quiet && ProgressBar::is_visible()) bar_.emplace(progress_);
  }

  int run() {
    try {
      load_and_build();
    } catch (const tracer::Cancelled&) {
      bar_.reset();
      fmt::print(stderr, "interrupted while {}: nothing written\n", progress_.stage());
      return exit_code::interrupted;
    }
    if (options_.pixel) describe_pixel();
    const bool is_rendered = !options_.output || render();
    if (options_.stats_file) write_stats(*options_.stats_file, options_, imported_, report_);
    if (interrupt_.was_interrupted()) return exit_code::interrupted;
    return is_rendered ? exit_code::success : exit_code::failure;
  }

 private:
  void load_and_build() {
    const Stopwatch load_start;
    progress_.start_stage("loading");
    imported_ = tracer::import_obj(options_.model, progress_);
    report_.seconds.load = load_start.seconds();
    if (!options_.is_quiet) print_loading_warnings();
    world_.scene = std::make_shared<tracer::Scene>(imported_.scene);
    resolve();

    const Stopwatch build_start;
    const BuiltAccel built = build_accel(
        imported_.scene.mesh,
        {options_.builder, options_.layout, options_.build, options_.improvement_rounds},
        progress_);
    world_.accel = built.accel;
    report_.seconds.build = build_start.seconds();
    report_.tree_bytes = world_.accel->bytes();
    if (built.tree && options_.stats_file) measure_tree(*built.tree);
  }

  void measure_tree(const tracer::BvhTree& tree) {
    progress_.start_stage("measuring the tree");
    report_.tree = measure(tree, sah_costs(options_.build));
    report_.tree_quality =
        measure_quality(tree, *imported_.scene.mesh, report_.tree.costs, progress_);
  }

  void print_loading_warnings() {
    const bool has_bar = bar_.has_value();
    bar_.reset();
    print_warnings(options_.model, imported_);
    if (has_bar) bar_.emplace(progress_);
  }

  void resolve() {
    const tracer::Mesh& mesh = *imported_.scene.mesh;
    report_.view = resolve_view(options_, mesh);
    if (options_.pixel) check_pixel(*options_.pixel, report_.view.size_px);
    world_.camera = make_camera_frame(report_.view.camera, report_.view.size_px, mesh.origin);
    world_.sky = report_.view.sky;
    world_.environment = load_environment(report_.view.environment);
    world_.zenith = tracer::zenith_of(report_.view.camera);
  }

  void describe_pixel() {
    const std::string text = describe_sample(world_, *options_.integrator, options_.render,
                                             *options_.pixel, options_.sample);
    fmt::print("{}{}", text, text.ends_with('\n') ? "" : "\n");
  }

  // Whether there was anything to write.
  bool render() {
    tracer::Film film(report_.view.size_px);
    const RenderedPasses rendered = render_passes(world_, options_, film, stop_, progress_);
    report_.passes = rendered.passes;
    report_.whole_sample_count = rendered.whole_sample_count;
    report_.error = rendered.error;
    report_.seconds.render = rendered.seconds;
    if (report_.passes.samples == 0) {
      bar_.reset();
      fmt::print(stderr, "stopped before the first sample: nothing written\n");
      return false;
    }
    const std::vector<tracer::ImageLayer> layers = render_layers(film);
    progress_.start_stage("writing");
    const Stopwatch start;
    write_image(*options_.output, film.image(), options_.render.exposure,
                picture_metadata(options_, report_), layers);
    report_.seconds.write = start.seconds();
    bar_.reset();
    print_dropped_samples();
    if (interrupt_.was_interrupted()) {
      fmt::print(stderr, "interrupted after {} samples a pixel; wrote {}\n",
                 report_.whole_sample_count, options_.output->string());
    } else if (!options_.is_quiet) {
      fmt::print(stderr, "{}\n", summary(options_, report_));
    }
    return true;
  }

  // An interrupted picture has them too, of one sample.
  std::vector<tracer::ImageLayer> render_layers(const tracer::Film& film) {
    if (options_.aovs.empty()) return {};
    progress_.start_stage("finding layers");
    const uint32_t most_samples =
        interrupt_.was_interrupted() ? 1 : std::max(report_.whole_sample_count, 1u);
    return render_aovs(options_.aovs, world_, options_.render, film, most_samples);
  }

  void print_dropped_samples() const {
    const tracer::PassStats& passes = report_.passes;
    if (!passes.first_dropped) return;
    fmt::print(stderr, "{}; for the first: {}\n", count_of_dropped(passes.dropped),
               replay_command(replay_arguments(options_.model, report_.view, *options_.integrator,
                                               options_.render, *passes.first_dropped)));
  }

  RenderOptions options_;
  tracer::Progress progress_;
  tracer::StopFlag stop_;
  InterruptGuard interrupt_;
  std::optional<ProgressBar> bar_;
  tracer::ImportedScene imported_;
  tracer::World world_;
  RenderReport report_;
};

}  // namespace

int render_command(const RenderOptions& options) {
  check_outputs(options);
  RenderOptions complete = options;
  if (complete.thread_count == 0) complete.thread_count = tracer::default_thread_count();
  return tracer::with_thread_count(complete.thread_count,
                                   [&] { return RenderJob(complete).run(); });
}

}  // namespace app
