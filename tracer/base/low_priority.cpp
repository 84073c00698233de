// SPDX-License-Identifier: MIT
#include "tracer/base/low_priority.h"

#include <future>
#include <thread>

#include <sys/resource.h>

#include "tracer/base/parallel.h"

namespace tracer {

// A thread of its own: without privileges a priority once lowered cannot be raised again.
void run_at_low_priority(const std::function<void()>& f) {
  std::packaged_task<void()> task([&f] {
    constexpr int niceness = 10;
    // On Linux that is the calling thread's alone. Where it fails, f runs all the same.
    setpriority(PRIO_PROCESS, 0, niceness);
    with_idle_threads(f);
  });
  std::future<void> done = task.get_future();
  std::thread thread(std::move(task));
  thread.join();
  done.get();
}

}  // namespace tracer
