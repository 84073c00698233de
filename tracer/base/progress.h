// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <exception>

namespace tracer {

/// Asks work in flight to end early. Any thread may request; the worker looks often enough that no
/// more than a few milliseconds pass.
class StopFlag {
 public:
  void request() { requested_.store(true, std::memory_order_relaxed); }
  void reset() { requested_.store(false, std::memory_order_relaxed); }
  bool requested() const { return requested_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> requested_{false};
};

/// Thrown by a load or a build whose Progress was asked to stop.
struct Cancelled : std::exception {
  const char* what() const noexcept override { return "cancelled"; }
};

/// One load or build, as both sides see it: the worker says where it is, any thread may watch it
/// and ask it to stop.
class Progress {
 public:
  /// `stage` is a string literal, shown to the user ("reading", "building the tree").
  void start_stage(const char* stage) {
    stage_.store(stage, std::memory_order_relaxed);
    fraction_.store(0, std::memory_order_relaxed);
  }
  /// Part of the stage that is done, 0 to 1.
  void set_fraction(double fraction) {
    fraction_.store(static_cast<float>(fraction), std::memory_order_relaxed);
  }
  const char* stage() const { return stage_.load(std::memory_order_relaxed); }
  float fraction() const { return fraction_.load(std::memory_order_relaxed); }

  void request_stop() { stop_.request(); }
  bool stop_requested() const { return stop_.requested(); }
  void throw_if_stopped() const {
    if (stop_.requested()) throw Cancelled{};
  }

 private:
  std::atomic<const char*> stage_{""};
  std::atomic<float> fraction_{0};
  StopFlag stop_;
};

}  // namespace tracer
