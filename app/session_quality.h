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
#include "tracer/bvh/tree.h"
#include "tracer/geometry/mesh.h"

namespace app {

/// A tree to be measured, let go once it is. Only the meter that it was given to looks inside.
struct QualityMeasurement {
  std::shared_ptr<const tracer::Mesh> mesh;
  std::shared_ptr<const tracer::BvhTree> tree;
  tracer::SahCosts costs;
  std::optional<tracer::TreeQuality> quality{};
};

/// Measures on one thread of low priority, once the user has rested for a moment, so that neither
/// picture nor sliders wait for it.
class QualityMeter {
 public:
  /// `notify` is called from any thread when there is a new result.
  explicit QualityMeter(std::function<void()> notify);
  ~QualityMeter();
  QualityMeter(const QualityMeter&) = delete;
  QualityMeter& operator=(const QualityMeter&) = delete;

  /// Of the tree in use from now on; nullptr: there is none.
  void set(std::shared_ptr<QualityMeasurement> measurement);
  /// The user is at work: what is being measured is begun again when that is over.
  void postpone();
  /// Of the tree in use, when it is known.
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
  std::shared_ptr<QualityMeasurement> measurement_;
  Clock::time_point rest_end_;
  std::shared_ptr<tracer::Progress> progress_;  // of what is being measured
  std::thread thread_;
};

}  // namespace app
