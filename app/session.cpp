// SPDX-License-Identifier: MIT
#include "app/session.h"

#include <utility>

#include "app/replay.h"
#include "app/session_changes.h"
#include "app/session_state.h"

namespace app {

Session::State::State(std::function<void()> wake_function)
    : wake(std::move(wake_function)),
      renderer([this] { post_news(); }),
      quality_meter([this] { post_news(); }),
      job_thread([this] { run_jobs(); }) {}

Session::State::~State() {
  {
    const std::lock_guard lock(mutex);
    is_quitting = true;
    if (job.progress) job.progress->request_stop();
  }
  changed.notify_one();
  job_thread.join();
}

void Session::State::post_news() {
  if (!has_news.exchange(true)) wake();
}

bool Session::State::wants_shading() const {
  return is_edited_model() && model->scene->shading != edits.shading;
}

bool Session::State::wants_tree() const {
  return model && !is_wanted(tree) && !(declined && is_same_tree(wanted_key(), *declined));
}

// Whoever switches improvement off wants the tree as it was built; on, one that can be improved.
bool Session::State::is_wanted(const BuiltTree& built) const {
  if (!is_same_tree(wanted_key(), built.key)) return false;
  if (!built.accel->has_tree()) return true;
  return edits.improve ? built.may_improve() || built.improvement.is_over
                       : built.improvement.rounds == 0;
}

// Not before there is a picture: the first passes have all threads for themselves.
bool Session::State::wants_improvement() {
  return edits.improve && is_edited_model() && tree.may_improve() && renderer.has_samples();
}

bool Session::State::has_idle_tree() const {
  return tree.tree && !(edits.improve && tree.may_improve());
}

std::shared_ptr<const tracer::World> Session::State::make_world() const {
  return std::make_shared<const tracer::World>(tracer::World{
      .scene = model->scene,
      .accel = tree.accel,
      .camera = make_camera_frame(edits.camera, edits.size_px, model->scene->mesh->origin),
      .sky = edits.sky,
      .environment = edits.environment.environment,
      .zenith = zenith_of(edits.camera)});
}

const tracer::Integrator& Session::State::integrator() const {
  return edits.integrator != nullptr ? *edits.integrator : tracer::integrators().front();
}

void Session::State::restart_picture() {
  renderer.restart({make_world(), &integrator(), edits.render, edits.size_px});
}

Status Session::State::status() {
  const RenderStatus render = renderer.status();
  Status status;
  status.is_loading = job.kind == JobKind::load || open_request.has_value();
  status.is_building = job.kind == JobKind::build || job.kind == JobKind::shade;
  status.is_rendering = render.is_rendering;
  const bool is_at_work = job.kind != JobKind::none && job.kind != JobKind::improve;
  status.is_answered = is_edited_model() && !is_at_work && !wants_tree() && !wants_shading() &&
                       render.is_picture_whole;
  status.is_improving = job.kind == JobKind::improve || wants_improvement();
  if (job.progress) {
    status.stage = job.progress->stage();
    status.fraction = job.progress->fraction();
  }
  status.loading_path = open_request ? open_request->string() : job.path;
  status.error = error;
  status.error_generation = error_generation;
  if (model) {
    status.model_path = model->path;
    status.model_generation = model->generation;
    status.model = model->imported;
    status.load_seconds = model->seconds;
  }
  status.builder = tree.accel ? tree.key.builder : nullptr;
  status.tree = tree.metrics;
  status.tree_bytes = tree.accel ? tree.bytes() : 0;
  status.tree_quality = quality_meter.quality();
  status.build_seconds = tree.seconds;
  status.improvement_rounds = tree.improvement.rounds;
  status.first_sah_cost = tree.improvement.first_sah_cost;
  status.mrays_per_second = render.rates.recent_mrays_per_second();
  status.mrays_per_second_bvh = render.rates.mrays_per_second(TraceMode::bvh);
  status.mrays_per_second_brute_force = render.rates.mrays_per_second(TraceMode::brute_force);
  status.is_finished = render.is_finished;
  status.samples = render.samples;
  status.mean_samples = static_cast<double>(render.passes.samples) /
                        (static_cast<double>(edits.size_px.x) * edits.size_px.y);
  status.errors = render.errors;
  status.rays = render.rates.rays();
  status.seconds = render.rates.seconds();
  status.dropped_samples = render.passes.dropped;
  if (render.passes.first_dropped) {
    status.replay = replay_command(replay_arguments(
        status.model_path, {edits.camera, edits.size_px, edits.sky, edits.environment.source},
        integrator(), edits.render, *render.passes.first_dropped));
  }
  return status;
}

Session::Session(std::function<void()> wake) : state_(std::make_unique<State>(std::move(wake))) {}

Session::~Session() = default;

void Session::open(const std::filesystem::path& path) {
  {
    const std::lock_guard lock(state_->mutex);
    state_->open_request = path;
    if (state_->job.progress) state_->job.progress->request_stop();
  }
  state_->changed.notify_one();
}

void Session::cancel_job() {
  const std::lock_guard lock(state_->mutex);
  state_->open_request.reset();
  if (!state_->job.progress) return;
  state_->job.progress->request_stop();
  if (state_->job.kind == JobKind::build) state_->declined = state_->job.key;
  if (state_->job.kind == JobKind::improve) state_->tree.improvement.is_over = true;
}

void Session::set(const Edits& edits) {
  {
    const std::lock_guard lock(state_->mutex);
    const Edits before = std::exchange(state_->edits, edits);
    state_->renderer.set_limits({.samples = edits.sample_limit, .error = edits.error_limit});
    state_->renderer.show(edits.shown);
    const bool needs_tree = is_new_tree(before, edits);
    const bool needs_picture = is_new_picture(before, edits);
    if (needs_tree || needs_picture) state_->quality_meter.postpone();
    if (needs_tree) state_->declined.reset();
    if (needs_picture && state_->is_edited_model()) state_->restart_picture();
    const Job& job = state_->job;
    if (job.kind == JobKind::build && !is_same_tree(job.key, state_->wanted_key())) {
      job.progress->request_stop();
    }
    if (job.kind == JobKind::improve &&
        (!edits.improve || state_->wants_tree() || state_->wants_shading())) {
      job.progress->request_stop();
    }
  }
  state_->changed.notify_one();
}

Update Session::poll() {
  state_->has_news = false;
  Update update;
  {
    const std::lock_guard lock(state_->mutex);
    update.status = state_->status();
    // That there is a picture by now is known here first.
    if (update.status.is_improving) state_->changed.notify_one();
  }
  TileQueue::Taken taken = state_->renderer.take_tiles();
  update.size_px = taken.size_px;
  update.tiles = std::move(taken.tiles);
  return update;
}

}  // namespace app
