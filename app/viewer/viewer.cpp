// SPDX-License-Identifier: MIT
#include "app/viewer/viewer.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include <GLFW/glfw3.h>

#include "tracer/base/byte_source.h"
#include "tracer/render/write_image.h"

namespace app {
namespace {

constexpr double tracing_interval = 1.0 / 30;
constexpr double input_interval = 1.0 / 60;
constexpr double job_interval = 1.0 / 20;
constexpr double minimised_interval = 0.5;
constexpr double watch_interval = 1.0;
// Frames after an input in which hovering, tooltips and sizes still change.
constexpr int frames_to_settle = 3;

std::filesystem::path layout_path(const ViewOptions& options) {
  if (options.ui_layout) return *options.ui_layout;
  const char* path = std::getenv("BOXWOOD_UI_LAYOUT");
  return path != nullptr ? path : "";
}

std::optional<tracer::View> load_first_view(const ViewOptions& options) {
  if (!options.view_file) return std::nullopt;
  return tracer::load_view(*options.view_file);
}

}  // namespace

Viewer::Viewer(const ViewOptions& options)
    : options_(options),
      first_view_(load_first_view(options)),
      window_("Boxwood", options.size_px),
      gui_(window_),
      layout_(layout_path(options)),
      screenshots_([] { Window::wake(); }),
      session_([this] {
        has_news_ = true;
        Window::wake();
      }) {
  settings_.set_environment(options.environment);
  environments_.make(options.environment);  // a file that cannot be read is said at once
  if (options.sample_limit > 0) settings_.sample_limit = options.sample_limit;
  if (options.error_limit) settings_.error_limit = *options.error_limit;
  if (options.frames > 0) settings_.sample_limit = options.frames;
}

int Viewer::run() {
  send_edits();  // the first load builds the tree that they ask for
  if (options_.model) open(*options_.model);
  frames_due_ = frames_to_settle;
  while (!window_.should_close() && !is_run_over()) {
    wait();
    if (window_.take_activity()) frames_due_ = frames_to_settle;
    for (const auto& path : window_.take_drops()) {
      open_dialog_.close();
      open(path);
    }
    watch_files();
    if (const double due = due_seconds(); due <= glfwGetTime()) draw_frame(due);
  }
  window_.hide();
  const bool is_failed = adopted_generation_ == 0 && reported_error_generation_ > 0;
  return options_.model && is_failed ? 2 : 0;
}

double Viewer::due_seconds() const {
  double due = std::numeric_limits<double>::infinity();
  const auto due_after = [&](double interval) {
    due = std::min(due, last_frame_seconds_ + interval);
  };
  const bool has_input = frames_due_ == frames_to_settle;
  if (frames_due_ > 0) {
    due_after(status_.is_rendering && !has_input ? tracing_interval : input_interval);
  }
  // The news may be that the job is done, which somebody waits for.
  if (has_news_) due_after(is_job_running() ? input_interval : tracing_interval);
  if (screenshots_.is_busy()) due_after(tracing_interval);
  if (is_job_running()) due_after(job_interval);
  if (!toast_.empty()) due = std::min(due, toast_end_seconds_);
  if (window_.framebuffer_px().x == 0)
    due = std::max(due, last_frame_seconds_ + minimised_interval);
  return due;
}

void Viewer::wait() {
  const double frame_wait = due_seconds() - glfwGetTime();
  const double timeout = has_file() ? std::min(frame_wait, watch_interval) : frame_wait;
  if (timeout <= 0) {
    window_.poll_events();
  } else if (timeout == std::numeric_limits<double>::infinity()) {
    window_.wait_events();
  } else {
    window_.wait_events(timeout);
  }
}

void Viewer::watch_files() {
  if (has_file() && !is_job_running() && file_watch_.has_changed(glfwGetTime())) {
    open(requested_path_);
  }
}

bool Viewer::has_file() const {
  return !requested_path_.empty() && !tracer::is_standard_input(requested_path_);
}

bool Viewer::has_finished_picture() const {
  const bool is_finished = status_.is_finished && !status_.is_rendering && !is_job_running();
  return adopted_generation_ > 0 && is_finished && !picture_.is_empty();
}

bool Viewer::is_run_over() const {
  if (options_.frames <= 0) return false;
  const bool is_failed = adopted_generation_ == 0 && !is_job_running();
  return is_captured_ || (is_failed && frames_drawn_ >= frames_to_settle);
}

void Viewer::draw_frame(double due_seconds) {
  // A frame that is a little late counts as on time: else sixty a second were fifty-nine.
  constexpr double tolerated_seconds = 0.002;
  const double now = glfwGetTime();
  last_frame_seconds_ = now - due_seconds < tolerated_seconds ? due_seconds : now;
  frames_due_ = std::max(frames_due_ - 1, 0);
  if (window_.framebuffer_px().x == 0) {
    take_update();
    return;
  }
  // The scale is known from here on, and with it the picture's aspect, which frames a new model.
  const std::vector<InputEvent> input = window_.take_input();
  gui_.begin_frame(input);
  lay_out();
  take_update();
  const bool is_last = options_.frames > 0 && has_finished_picture();
  handle_input(input);
  lay_out();  // a key may have hidden the panel
  const Ui ui{layout_, gui_.fonts(), gui_.scale()};
  draw_panel(ui);
  const double answered_seconds = glfwGetTime();
  draw_overlays(ui);
  send_edits();
  draw_background();
  gui_.render();
  ++frames_drawn_;
  if (is_last && frames_drawn_ > frames_to_settle) {
    if (options_.screenshot) {
      tracer::write_image(*options_.screenshot, read_framebuffer(window_.framebuffer_px()), 0);
    }
    is_captured_ = true;
  }
  if (is_last) frames_due_ = 1;
  window_.swap();
  draw_seconds_ = glfwGetTime() - answered_seconds;
  layout_.finish_frame();  // it tells of what is on the screen
}

}  // namespace app
