// SPDX-License-Identifier: MIT
// What a session's thread and its callers share.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/session.h"
#include "app/session_jobs.h"
#include "app/session_quality.h"
#include "app/session_renderer.h"

namespace app {

enum class JobKind { none, load, shade, build, improve };

/// The job in flight.
struct Job {
  JobKind kind = JobKind::none;
  std::string path;  // of a load
  TreeKey key;       // of a build
  std::shared_ptr<tracer::Progress> progress;
};

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

  TreeKey wanted_key() const { return {edits.builder, edits.layout, edits.build}; }
  bool wants_shading() const;
  bool wants_tree() const;
  bool is_wanted(const BuiltTree& built) const;
  bool wants_improvement();
  bool has_idle_tree() const;
  void let_go_of_tree(std::unique_lock<std::mutex>& lock);
  bool is_edited_model() const { return model && edits.model_generation == model->generation; }
  std::shared_ptr<const tracer::World> make_world() const;
  const tracer::Integrator& integrator() const;
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

}  // namespace app
