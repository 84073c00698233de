// SPDX-License-Identifier: MIT
#include "app/session.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>

#include "app/session_changes.h"
#include "app/session_jobs.h"
#include "app/session_quality.h"
#include "app/session_renderer.h"
#include "tracer/base/freed_memory.h"
#include "tracer/base/low_priority.h"

namespace app {
namespace {

enum class JobKind { none, load, shade, build, improve };

/// The job in flight.
struct Job {
  JobKind kind = JobKind::none;
  std::string path;  // of a load
  TreeKey key;       // of a build
  std::shared_ptr<tracer::Progress> progress;
};

TreeKey tree_key_of(const Edits& edits) {
  return {edits.builder, edits.layout, edits.build};
}

}  // namespace

/// One mutex guards all of it; it is held for moments, never while a job or a pass runs.
struct Session::State {
  explicit State(std::function<void()> wake_function);
  ~State();

  void run_jobs();
  void load(std::unique_lock<std::mutex>& lock);
  void shade(std::unique_lock<std::mutex>& lock);
  void build(std::unique_lock<std::mutex>& lock);
  void improve(std::unique_lock<std::mutex>& lock);
  std::shared_ptr<tracer::Progress> begin_job(JobKind kind, std::string path);
  void end_job();
  void set_error(std::string text);

  void use_tree(BuiltTree built);

  bool wants_shading() const;
  bool wants_tree() const;
  bool is_wanted(const BuiltTree& built) const;
  bool wants_improvement();
  bool has_idle_tree() const;
  void let_go_of_tree(std::unique_lock<std::mutex>& lock);
  bool is_edited_model() const { return model && edits.model_generation == model->generation; }
  std::shared_ptr<const tracer::World> make_world() const;
  void restart_picture();
  void post_news();
  Status status();

  std::function<void()> wake;
  std::atomic<bool> has_news{false};
  SessionRenderer renderer;
  QualityMeter quality_meter;

  std::mutex mutex;
  std::condition_variable changed;
  bool is_quitting = false;
  Edits edits;
  std::optional<std::filesystem::path> open_request;
  Job job;
  std::string error;
  uint64_t error_generation = 0;
  std::optional<LoadedModel> model;
  BuiltTree tree;                     // over the model
  std::optional<BuiltTree> off_tree;  // the one that was in use when the BVH was switched off
  std::optional<TreeKey> declined;    // cancelled by the user
  uint64_t generation = 0;

  std::thread job_thread;
};

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

void Session::State::run_jobs() {
  tracer::lower_priority(tracer::Priority::background);  // the window comes first
  std::unique_lock lock(mutex);
  while (!is_quitting) {
    if (open_request) {
      load(lock);
    } else if (wants_shading()) {
      shade(lock);
    } else if (wants_tree()) {
      build(lock);
    } else if (wants_improvement()) {
      improve(lock);
    } else if (has_idle_tree()) {
      let_go_of_tree(lock);
    } else {
      changed.wait(lock);
    }
  }
}

bool Session::State::wants_shading() const {
  return is_edited_model() && model->scene->shading != edits.shading;
}

bool Session::State::wants_tree() const {
  return model && !is_wanted(tree) && !(declined && is_same_tree(tree_key_of(edits), *declined));
}

// Whoever switches improvement off wants the tree as it was built; on, one that can be improved.
bool Session::State::is_wanted(const BuiltTree& built) const {
  if (!is_same_tree(tree_key_of(edits), built.key)) return false;
  if (!built.accel->has_tree()) return true;
  return edits.improve ? built.may_improve() || built.improvement.is_over
                       : built.improvement.rounds == 0;
}

// Not before there is a picture: the first passes have all threads for themselves.
bool Session::State::wants_improvement() {
  return edits.improve && is_edited_model() && tree.may_improve() && renderer.status().samples > 0;
}

bool Session::State::has_idle_tree() const {
  return tree.tree && !(edits.improve && tree.may_improve());
}

void Session::State::let_go_of_tree(std::unique_lock<std::mutex>& lock) {
  auto idle = std::exchange(tree.tree, nullptr);
  const bool was_improved = tree.improvement.is_over;
  lock.unlock();
  idle.reset();
  // After a mere build another may follow soon, which is quicker in memory that is there.
  if (was_improved) tracer::give_back_freed_memory();
  lock.lock();
  post_news();
}

std::shared_ptr<tracer::Progress> Session::State::begin_job(JobKind kind, std::string path) {
  job = {kind, std::move(path), tree_key_of(edits), std::make_shared<tracer::Progress>()};
  post_news();
  return job.progress;
}

void Session::State::end_job() {
  job = {};
  post_news();
}

void Session::State::set_error(std::string text) {
  error = std::move(text);
  ++error_generation;
}

void Session::State::load(std::unique_lock<std::mutex>& lock) {
  const std::filesystem::path path = *std::exchange(open_request, std::nullopt);
  error.clear();
  const auto progress = begin_job(JobKind::load, path.string());
  const TreeKey key = job.key;
  const bool is_reload = model && model->path == path.string();
  const tracer::Shading shading = edits.shading;
  lock.unlock();

  std::optional<LoadedModel> loaded;
  BuiltTree built;
  std::string failure;
  try {
    LoadedModel result = load_model(path, *progress);
    if (is_reload) {
      result.scene = std::make_shared<const tracer::Scene>(with_shading(*result.scene, shading));
    }
    built = build_tree(result.scene->mesh, key, *progress);
    loaded = std::move(result);
  } catch (const tracer::Cancelled&) {
  } catch (const std::bad_alloc&) {
    failure = path.string() + ": needs more memory than there is";
  } catch (const std::exception& exception) {
    failure = exception.what();
  }

  lock.lock();
  if (!failure.empty()) set_error(failure);
  if (loaded && !progress->stop_requested()) {
    model = std::move(loaded);
    model->generation = ++generation;
    use_tree(std::move(built));
    off_tree.reset();
    declined.reset();
  }
  end_job();
}

void Session::State::shade(std::unique_lock<std::mutex>& lock) {
  const auto progress = begin_job(JobKind::shade, {});
  progress->start_stage("computing normals");
  const tracer::Shading shading = edits.shading;
  const std::shared_ptr<const tracer::Scene> before = model->scene;
  lock.unlock();
  auto scene = std::make_shared<const tracer::Scene>(with_shading(*before, shading));
  lock.lock();
  model->scene = std::move(scene);
  if (is_edited_model()) restart_picture();
  end_job();
}

void Session::State::build(std::unique_lock<std::mutex>& lock) {
  const auto progress = begin_job(JobKind::build, {});
  const TreeKey key = job.key;
  const auto mesh = model->scene->mesh;
  std::optional<BuiltTree> built;
  if (off_tree && is_wanted(*off_tree)) built = off_tree;
  lock.unlock();

  std::string failure;
  try {
    if (!built) built = build_tree(mesh, key, *progress);
  } catch (const tracer::Cancelled&) {
  } catch (const std::exception& exception) {
    failure = std::string("the tree cannot be built: ") + exception.what();
  }

  lock.lock();
  if (!failure.empty()) {
    set_error(failure);
    declined = key;
  }
  if (built) {
    off_tree.reset();
    if (key.builder == nullptr) off_tree = std::move(tree);
    use_tree(std::move(*built));
    if (is_edited_model()) renderer.resume_with(make_world());
  }
  end_job();
}

void Session::State::use_tree(BuiltTree built) {
  tree = std::move(built);
  quality_meter.set(tree.measurement);
}

void Session::State::improve(std::unique_lock<std::mutex>& lock) {
  const auto progress = begin_job(JobKind::improve, {});
  const BuiltTree before = tree;
  lock.unlock();

  std::optional<BuiltTree> improved;
  try {
    improved = improve_tree(before, *progress);
  } catch (const tracer::Cancelled&) {
  } catch (const std::exception&) {
    improved = before;  // short of memory, the tree stays as it is
    improved->improvement.is_over = true;
  }

  lock.lock();
  if (improved && !progress->stop_requested()) {
    const bool is_better = improved->accel != before.accel;
    use_tree(std::move(*improved));
    if (is_better && is_edited_model()) renderer.resume_with(make_world());
  }
  end_job();
}

std::shared_ptr<const tracer::World> Session::State::make_world() const {
  return std::make_shared<const tracer::World>(tracer::World{
      .scene = model->scene,
      .accel = tree.accel,
      .camera = make_camera_frame(edits.camera, edits.size_px, model->scene->mesh->origin),
      .sky = edits.sky});
}

void Session::State::restart_picture() {
  const tracer::Integrator* integrator =
      edits.integrator != nullptr ? edits.integrator : &tracer::integrators().front();
  renderer.restart({make_world(), integrator, edits.render, edits.size_px});
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
  status.tree = tree.metrics;
  status.tree_bytes = tree.accel ? tree.bytes() : 0;
  status.tree_quality = quality_meter.quality();
  status.build_seconds = tree.seconds;
  status.improvement_rounds = tree.improvement.rounds;
  status.first_sah_cost = tree.improvement.first_sah_cost;
  status.mrays_per_second = render.rates.recent_mrays_per_second();
  status.mrays_per_second_bvh = render.rates.mrays_per_second(TraceMode::bvh);
  status.mrays_per_second_brute_force = render.rates.mrays_per_second(TraceMode::brute_force);
  status.samples = render.samples;
  status.rays = render.rates.rays();
  status.seconds = render.rates.seconds();
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
    state_->renderer.set_sample_limit(edits.sample_limit);
    const bool needs_tree = is_new_tree(before, edits);
    const bool needs_picture = is_new_picture(before, edits);
    if (needs_tree || needs_picture) state_->quality_meter.postpone();
    if (needs_tree) state_->declined.reset();
    if (needs_picture && state_->is_edited_model()) state_->restart_picture();
    const Job& job = state_->job;
    if (job.kind == JobKind::build && !is_same_tree(job.key, tree_key_of(edits))) {
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
