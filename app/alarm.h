// SPDX-License-Identifier: MIT
// Something to be done when time is up.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace app {

/// Calls a function, on a thread of its own, when the time that was set has passed.
class Alarm {
 public:
  explicit Alarm(std::function<void()> ring);
  ~Alarm();
  Alarm(const Alarm&) = delete;
  Alarm& operator=(const Alarm&) = delete;

  /// Rings once, `seconds` from now, unless cleared or set anew before.
  void set(double seconds);
  /// It does not ring after this returns.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void run();

  std::function<void()> ring_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_quitting_ = false;
  std::optional<Clock::time_point> due_;
  std::optional<Clock::time_point> wakes_at_;  // the thread sleeps until then; none: until notified
  std::thread thread_;
};

}  // namespace app
