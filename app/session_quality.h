// SPDX-License-Identifier: MIT
// The thread that measures the tree in use while nobody needs it for anything better.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "tracer/bvh/quality.h"
#include "tracer/bvh/trace/accel.h"

namespace app {

/// Measures on one thread of low priority, once the user has rested for a moment, so that neither
/// picture nor sliders wait for it.
class QualityMeter {
 public:
  /// `notify` is called from any thread when there is a new result.
  explicit QualityMeter(std::function<void()> notify);
  ~QualityMeter();
  QualityMeter(const QualityMeter&) = delete;
  QualityMeter& operator=(const QualityMeter&) = delete;

  /// Forgets the tree before; nullptr, or one without a tree: there is nothing to measure.
  void set_accel(std::shared_ptr<const tracer::Accel> accel);
  /// The user is at work: what is being measured is begun again when that is over.
  void postpone();
  /// Of the tree that was set last, when it is known.
  std::optional<tracer::TreeQuality> quality();

 private:
  using Clock = std::chrono::steady_clock;
  void run();
  void measure(std::unique_lock<std::mutex>& lock);
  void restart_rest();

  std::function<void()> notify_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_quitting_ = false;
  std::shared_ptr<const tracer::Accel> accel_;  // to be measured
  std::optional<tracer::TreeQuality> quality_;
  Clock::time_point rest_end_;
  std::shared_ptr<tracer::Progress> progress_;  // of what is being measured
  std::thread thread_;
};

}  // namespace app
