// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>

#include "tracer/base/progress.h"

namespace app {

/// While it lives, the first Ctrl-C (or SIGTERM) asks the work in flight to end early; the second
/// ends the program as ever. One at a time.
class InterruptGuard {
 public:
  /// Both must outlive the guard: `loading` for what throws Cancelled, `rendering` for what keeps
  /// its result so far.
  InterruptGuard(tracer::Progress& loading, tracer::StopFlag& rendering);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool was_interrupted() const;

 private:
  struct sigaction previous_interrupt_;
  struct sigaction previous_terminate_;
};

}  // namespace app
