// SPDX-License-Identifier: MIT
#include "tests/bench/compare/pinned_threads.h"

#include <algorithm>
#include <atomic>
#include <barrier>
#include <numeric>
#include <thread>
#include <vector>

#include <sched.h>
#include <time.h>

namespace bench {
namespace {

std::vector<int> allowed_processors() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  std::vector<int> processors;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return {0};
  for (int i = CPU_SETSIZE - 1; i >= 0; --i) {
    if (CPU_ISSET(i, &allowed)) processors.push_back(i);
  }
  return processors;
}

void pin_to(int processor) {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(processor, &one);
  sched_setaffinity(0, sizeof one, &one);
}

// Of the calling thread.
double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) / 1e9;
}

}  // namespace

int processor_count() {
  return static_cast<int>(allowed_processors().size());
}

double run_pinned(int thread_count, size_t count, size_t grain,
                  const std::function<void(size_t first, size_t last)>& f) {
  const std::vector<int> processors = allowed_processors();
  std::atomic<size_t> next{0};
  std::vector<double> seconds(static_cast<size_t>(thread_count));
  std::barrier gate(thread_count);
  const auto work = [&](size_t worker) {
    pin_to(processors.at(worker));
    gate.arrive_and_wait();
    const double start = processor_seconds();
    for (size_t first = next.fetch_add(grain); first < count; first = next.fetch_add(grain)) {
      f(first, std::min(first + grain, count));
    }
    seconds[worker] = processor_seconds() - start;
  };
  std::vector<std::thread> threads;
  for (size_t worker = 0; worker < seconds.size(); ++worker) threads.emplace_back(work, worker);
  for (std::thread& thread : threads) thread.join();
  return std::accumulate(seconds.begin(), seconds.end(), 0.0) / thread_count;
}

}  // namespace bench
