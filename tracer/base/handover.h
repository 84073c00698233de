// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

namespace tracer {

#if defined(__SANITIZE_THREAD__)

extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
extern "C" void __tsan_ignore_thread_begin();
extern "C" void __tsan_ignore_thread_end();

/// Tells ThreadSanitizer what a task scheduler that is not instrumented guarantees: what was
/// written before give() is seen after the take() that follows it on another thread.
class Handover {
 public:
  void give() { __tsan_release(this); }
  void take() { __tsan_acquire(this); }

 private:
  char address_ = 0;
};

/// Whether this thread runs the scheduler's own code, which is looked at where it is inlined, while
/// what orders it is not: it counts down on stacks that are used again as soon as it is done.
inline bool set_in_scheduler(bool is_in) {
  struct State {
    bool is_in = false;
    ~State() {
      if (is_in) __tsan_ignore_thread_end();
    }
  };
  thread_local State state;
  if (is_in && !state.is_in) __tsan_ignore_thread_begin();
  if (!is_in && state.is_in) __tsan_ignore_thread_end();
  return std::exchange(state.is_in, is_in);
}

#else

class Handover {
 public:
  void give() {}
  void take() {}
};

inline bool set_in_scheduler(bool is_in) {
  return is_in;
}

#endif

}  // namespace tracer
