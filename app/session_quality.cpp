// SPDX-License-Identifier: MIT
#include "app/session_quality.h"

#include <new>
#include <utility>

#include "tracer/base/freed_memory.h"
#include "tracer/base/low_priority.h"
#include "tracer/base/parallel.h"

namespace app {
namespace {

constexpr std::chrono::milliseconds rest{300};

}  // namespace

QualityMeter::QualityMeter(std::function<void()> notify)
    : notify_(std::move(notify)), thread_([this] { run(); }) {}

QualityMeter::~QualityMeter() {
  {
    const std::lock_guard lock(mutex_);
    is_quitting_ = true;
    if (progress_) progress_->request_stop();
  }
  changed_.notify_one();
  thread_.join();
}

void QualityMeter::set(std::shared_ptr<QualityMeasurement> measurement) {
  {
    const std::lock_guard lock(mutex_);
    measurement_ = std::move(measurement);
    restart_rest();
  }
  changed_.notify_one();
}

void QualityMeter::postpone() {
  const std::lock_guard lock(mutex_);
  restart_rest();
}

void QualityMeter::restart_rest() {
  rest_end_ = Clock::now() + rest;
  if (progress_) progress_->request_stop();
}

std::optional<tracer::TreeQuality> QualityMeter::quality() {
  const std::lock_guard lock(mutex_);
  return measurement_ ? measurement_->quality : std::nullopt;
}

void QualityMeter::run() {
  tracer::lower_priority(tracer::Priority::idle);
  std::unique_lock lock(mutex_);
  while (!is_quitting_) {
    if (!measurement_ || !measurement_->tree) {
      changed_.wait(lock);
    } else if (Clock::now() < rest_end_) {
      const Clock::time_point due = rest_end_;
      changed_.wait_until(lock, due);
    } else {
      measure(lock);
    }
  }
}

void QualityMeter::measure(std::unique_lock<std::mutex>& lock) {
  const auto progress = progress_ = std::make_shared<tracer::Progress>();
  const auto measurement = measurement_;
  auto tree = measurement->tree;
  lock.unlock();
  std::optional<tracer::TreeQuality> measured;
  try {
    tracer::on_one_thread([&] {
      measured = measure_quality(*tree, *measurement->mesh, measurement->costs, *progress);
    });
  } catch (const tracer::Cancelled&) {
  } catch (const std::bad_alloc&) {
    // The picture needs the memory more.
  }
  lock.lock();
  progress_.reset();
  if (progress->stop_requested()) return;
  measurement->quality = measured;
  measurement->tree.reset();
  lock.unlock();
  tree.reset();
  tracer::give_back_freed_memory();
  lock.lock();
  notify_();
}

}  // namespace app
