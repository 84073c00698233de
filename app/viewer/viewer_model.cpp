// SPDX-License-Identifier: MIT
// Viewer: models, tiles and news from the session, edits to it.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <system_error>
#include <thread>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "app/viewer/panels/overlay.h"
#include "app/viewer/viewer.h"
#include "tracer/base/byte_source.h"

namespace app {
namespace {

void report_warnings(const tracer::ImportedScene& model) {
  for (const tracer::Message& message : model.warnings.messages()) {
    fmt::print(stderr, "{}\n", message.text());
  }
  if (model.warnings.count() > 0) fmt::print(stderr, "{}\n", summarize(model));
}

/// What shows a model best at first sight: light where it brings its own, else its shape.
const tracer::Integrator* first_integrator(const tracer::Scene& scene) {
  const char* name = scene.lights && !scene.lights->empty() ? "path" : "eyelight";
  const tracer::Integrator* found = tracer::find_integrator(name);
  return found != nullptr ? found : &tracer::integrators().front();
}

}  // namespace

void Viewer::open(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(path, error);
  requested_path_ = error || tracer::is_standard_input(path) ? path : absolute;
  file_watch_.watch(requested_path_);  // before it is read: a change during the load counts
  session_.open(requested_path_);
  shown_error_.clear();
  status_.is_loading = true;
  job_start_seconds_ = glfwGetTime();
}

void Viewer::take_update() {
  has_news_ = false;
  const bool was_running = is_job_running();
  Update update = session_.poll();
  status_ = std::move(update.status);
  if (is_job_running() && !was_running) job_start_seconds_ = glfwGetTime();
  picture_.update(update.size_px, update.tiles);
  report_error();
  if (status_.model_generation != adopted_generation_) adopt_model();
  if (const auto message = screenshots_.take_message()) show_toast(*message);
}

void Viewer::report_error() {
  if (status_.error_generation == reported_error_generation_) return;
  reported_error_generation_ = status_.error_generation;
  shown_error_ = status_.error;
  if (!shown_error_.empty()) fmt::print(stderr, "{}\n", shown_error_);
}

std::optional<tracer::View> Viewer::find_view() {
  if (first_view_) return std::exchange(first_view_, std::nullopt);
  const std::filesystem::path path = tracer::view_path_of(status_.model_path);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  try {
    return tracer::load_view(path);
  } catch (const std::exception& exception) {
    fmt::print(stderr, "{}\n", exception.what());
    shown_error_ = exception.what();
    return std::nullopt;
  }
}

void Viewer::adopt_model() {
  const tracer::ImportedScene& model = *status_.model;
  if (status_.model_path == adopted_path_) {
    viewpoint_.reload(*model.scene.mesh);
  } else {
    const auto view = find_view();
    settings_.up = UpAxis::automatic;
    viewpoint_.set_up(settings_.up, aspect());
    viewpoint_.open(*model.scene.mesh, view, aspect());
    settings_.shading = model.scene.shading;
    if (adopted_generation_ == 0) settings_.integrator = first_integrator(model.scene);
    if (view && view->sky) settings_.set_sky(*view->sky);
    window_.set_title(tracer::short_name_of_input(status_.model_path) + " - Boxwood");
  }
  adopted_generation_ = status_.model_generation;
  adopted_path_ = status_.model_path;
  for (const std::filesystem::path& file : model.files) file_watch_.add(file);
  are_warnings_shown_ = model.warnings.count() > 0;
  report_warnings(model);
}

// While a hand drags on, the tree under way is finished and shown before the next is begun; were it
// given up for each new value, a large model would show none until the hand rests.
void Viewer::hold_back_build() {
  const bool is_dragged = settings_.is_build_dragged;
  if (is_dragged && was_build_dragged_ && status_.is_building) return;
  sent_build_ = settings_.build;
  was_build_dragged_ = is_dragged;
}

void Viewer::send_edits() {
  hold_back_build();
  viewpoint_.set_up(settings_.up, aspect());
  // The colours of a map stand for numbers.
  picture_.set_exposure(settings_.shown == ShownMap::picture ? settings_.render.exposure : 0);
  const uint32_t triangle_count = status_.model ? status_.model->scene.mesh->triangle_count() : 0;
  const tracer::Vec2d size = round(area_.size * gui_.pixel_ratio());
  session_.set({.model_generation = adopted_generation_,
                .camera = viewpoint_.camera(),
                .size_px = max(tracer::Vec2i(size), tracer::Vec2i(1)),
                .sky = settings_.sky(),
                .environment = environments_.make(settings_.environment_source()),
                .shading = settings_.shading,
                .integrator = settings_.integrator,
                .render = settings_.render,
                .builder = settings_.builder_for(triangle_count),
                .layout = settings_.layout,
                .build = sent_build_,
                .improve = settings_.improves_tree,
                .sample_limit = settings_.sample_limit,
                .error_limit = settings_.error_limit,
                .shown = settings_.shown});
}

// Edits are sent, and what answers them soon is awaited, so that this frame shows it: a frame is
// rather a little late than the picture a frame behind the mouse.
void Viewer::answer_edits() {
  constexpr double frame_seconds = 1.0 / 60;
  constexpr auto pause = std::chrono::microseconds(300);
  const bool was_answered = status_.is_answered && !is_job_running();
  send_edits();
  if (!was_answered) return;
  const double end_seconds = std::max(last_frame_seconds_ + frame_seconds - draw_seconds_,
                                      glfwGetTime() + frame_seconds / 2);
  for (take_update(); !status_.is_answered && glfwGetTime() < end_seconds; take_update()) {
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace app
