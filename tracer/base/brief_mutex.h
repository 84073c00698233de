// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <thread>

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace tracer {

/// A mutex for what takes some microseconds: who waits looks again for a while before it sleeps, as
/// to be woken takes longer than that.
class BriefMutex {
 public:
  void lock() {
    for (int looks = 0; looks < most_looks; ++looks) {
      if (mutex_.try_lock()) return;
      pause();
    }
    mutex_.lock();
  }
  void unlock() { mutex_.unlock(); }

 private:
  static void pause() {
#ifdef __SSE2__
    for (int i = 0; i < 8; ++i) _mm_pause();
#else
    std::this_thread::yield();
#endif
  }

  static constexpr int most_looks = 256;  // of a fifth of a microsecond or so
  std::mutex mutex_;
};

}  // namespace tracer
