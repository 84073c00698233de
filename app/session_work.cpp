// SPDX-License-Identifier: MIT
// Session::State: what its thread does, and in which order.
#include <exception>
#include <new>
#include <utility>

#include "app/session_state.h"
#include "tracer/base/freed_memory.h"
#include "tracer/base/low_priority.h"

namespace app {

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
  job = {kind, std::move(path), wanted_key(), std::make_shared<tracer::Progress>()};
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

}  // namespace app
