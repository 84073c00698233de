// SPDX-License-Identifier: MIT
#include "tracer/base/low_priority.h"

#include <future>
#include <thread>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

#include "tracer/base/parallel.h"

namespace tracer {

void lower_priority([[maybe_unused]] Priority priority) {
#ifdef __linux__
  // On Linux each thread has a niceness of its own, and new ones inherit it. An idle thread has
  // about a tenth of the share of one in the background.
  const int niceness = priority == Priority::background ? 10 : 19;
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness);
#endif
}

// A thread of its own: without privileges a priority once lowered cannot be raised again.
void run_at_low_priority(const std::function<void()>& f) {
  std::packaged_task<void()> task([&f] {
    lower_priority(Priority::idle);
    with_idle_threads(f);
  });
  std::future<void> done = task.get_future();
  std::thread thread(std::move(task));
  thread.join();
  done.get();
}

}  // namespace tracer
