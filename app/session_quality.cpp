// SPDX-License-Identifier: MIT
#include "app/session_quality.h"

#include <new>
#include <utility>

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

void QualityMeter::set_accel(std::shared_ptr<const tracer::Accel> accel) {
  {
    const std::lock_guard lock(mutex_);
    accel_ = accel && accel->tree ? std::move(accel) : nullptr;
    quality_.reset();
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
  return quality_;
}

void QualityMeter::run() {
  tracer::lower_priority(tracer::Priority::idle);
  std::unique_lock lock(mutex_);
  while (!is_quitting_) {
    if (!accel_) {
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
  const auto accel = accel_;
  lock.unlock();
  std::optional<tracer::TreeQuality> measured;
  try {
    tracer::on_one_thread([&] {
      measured = measure_quality(*accel->tree, *accel->mesh, tracer::SahCosts{}, *progress);
    });
  } catch (const tracer::Cancelled&) {
  } catch (const std::bad_alloc&) {
    // The picture needs the memory more.
  }
  lock.lock();
  progress_.reset();
  if (progress->stop_requested()) return;
  accel_.reset();
  quality_ = measured;
  notify_();
}

}  // namespace app
