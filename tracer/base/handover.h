// SPDX-License-Identifier: MIT
#pragma once

namespace tracer {

#if defined(__SANITIZE_THREAD__)

extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);

/// Tells ThreadSanitizer what a task scheduler that is not instrumented guarantees: what was
/// written before give() is seen after the take() that follows it on another thread.
class Handover {
 public:
  void give() { __tsan_release(this); }
  void take() { __tsan_acquire(this); }

 private:
  char address_ = 0;
};

#else

class Handover {
 public:
  void give() {}
  void take() {}
};

#endif

}  // namespace tracer
