// SPDX-License-Identifier: MIT
#include "app/alarm.h"

#include <utility>

namespace app {

Alarm::Alarm(std::function<void()> ring) : ring_(std::move(ring)), thread_([this] { run(); }) {}

Alarm::~Alarm() {
  {
    const std::lock_guard lock(mutex_);
    is_quitting_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Alarm::set(double seconds) {
  const auto due = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(seconds));
  bool wakes_in_time = false;
  {
    const std::lock_guard lock(mutex_);
    due_ = due;
    wakes_in_time = wakes_at_ && *wakes_at_ <= due;
  }
  // Passes may be short and many: the thread is not woken for each.
  if (!wakes_in_time) changed_.notify_one();
}

void Alarm::clear() {
  const std::lock_guard lock(mutex_);
  due_.reset();
}

void Alarm::run() {
  std::unique_lock lock(mutex_);
  while (!is_quitting_) {
    wakes_at_ = due_;
    if (!due_) {
      changed_.wait(lock);
    } else if (Clock::now() < *due_) {
      changed_.wait_until(lock, *wakes_at_);
    } else {
      due_.reset();
      ring_();
    }
  }
}

}  // namespace app
