// SPDX-License-Identifier: MIT
// The only place that names oneTBB's loops.
#pragma once

#include <atomic>
#include <cstddef>
#include <utility>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/task_arena.h>

#include "tracer/base/handover.h"

namespace tracer {

inline int default_thread_count() {
  return oneapi::tbb::info::default_concurrency();
}

namespace parallel_detail {

/// What a parallel call gives to its tasks, and they give back to it.
class ForkJoin {
 public:
  ForkJoin() : was_in_scheduler_(set_in_scheduler(true)) { fork_.give(); }
  ~ForkJoin() {
    join_.take();
    set_in_scheduler(was_in_scheduler_);
  }
  ForkJoin(const ForkJoin&) = delete;
  ForkJoin& operator=(const ForkJoin&) = delete;

  template <class F>
  decltype(auto) run_task(F&& task) {
    set_in_scheduler(false);
    fork_.take();
    const TaskEnd end{join_};
    return task();
  }

 private:
  struct TaskEnd {
    Handover& join;
    ~TaskEnd() {
      join.give();
      set_in_scheduler(true);
    }
  };

  const bool was_in_scheduler_;
  Handover fork_;
  Handover join_;
};

}  // namespace parallel_detail

/// Calls f(begin, end) on parts of [begin, end) of about `grain` elements.
template <class F>
void parallel_for_ranges(size_t begin, size_t end, size_t grain, F&& f) {
  using Range = oneapi::tbb::blocked_range<size_t>;
  parallel_detail::ForkJoin fork_join;
  oneapi::tbb::parallel_for(Range(begin, end, grain), [&](const Range& range) {
    fork_join.run_task([&] { f(range.begin(), range.end()); });
  });
}

/// Whether f(begin, end) is true of any part of [begin, end) of about `grain` elements.
template <class F>
bool parallel_any_of_ranges(size_t begin, size_t end, size_t grain, F&& f) {
  std::atomic<bool> is_any{false};
  parallel_for_ranges(begin, end, grain, [&](size_t part_begin, size_t part_end) {
    if (f(part_begin, part_end)) is_any.store(true, std::memory_order_relaxed);
  });
  return is_any;
}

/// Calls f(i) for each i in [begin, end), one task each.
template <class F>
void parallel_for_each_index(size_t begin, size_t end, F&& f) {
  parallel_detail::ForkJoin fork_join;
  oneapi::tbb::parallel_for(begin, end, [&](size_t i) { fork_join.run_task([&] { f(i); }); });
}

/// Calls f() as often as there are threads: f takes work until there is none, as the first call may
/// have taken all of it before the last begins.
template <class F>
void parallel_workers(F&& f) {
  const int worker_count = oneapi::tbb::this_task_arena::max_concurrency();
  parallel_detail::ForkJoin fork_join;
  oneapi::tbb::parallel_for(0, worker_count, [&](int) { fork_join.run_task([&] { f(); }); });
}

/// Calls f(i) for each i in [0, count), handed out one by one in that order: the first are begun
/// first.
template <class F>
void parallel_in_order(size_t count, F&& f) {
  std::atomic<size_t> next{0};
  parallel_workers([&] {
    for (size_t i = next++; i < count; i = next++) f(i);
  });
}

/// Calls f() and g(). Where a task elsewhere throws, either may be left out.
template <class F, class G>
void parallel_invoke(F&& f, G&& g) {
  parallel_detail::ForkJoin fork_join;
  oneapi::tbb::parallel_invoke([&] { fork_join.run_task(f); }, [&] { fork_join.run_task(g); });
}

/// Runs f() and all parallel work below it on the calling thread, and limits no other.
template <class F>
void on_one_thread(F&& f) {
  oneapi::tbb::task_arena arena(1);
  parallel_detail::ForkJoin fork_join;
  arena.execute([&] { fork_join.run_task(f); });
}

/// Runs f() and all parallel work below it on exactly `thread_count` threads, which may be more
/// than there are cores.
template <class F>
decltype(auto) with_thread_count(int thread_count, F&& f) {
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<size_t>(thread_count));
  oneapi::tbb::task_arena arena(thread_count);
  parallel_detail::ForkJoin fork_join;
  return arena.execute([&]() -> decltype(auto) { return fork_join.run_task(f); });
}

/// Runs f() on this thread and gives its parallel work to those that others leave idle.
template <class F>
decltype(auto) with_idle_threads(F&& f) {
  using oneapi::tbb::task_arena;
  task_arena arena(task_arena::automatic, 1, task_arena::priority::low);
  parallel_detail::ForkJoin fork_join;
  return arena.execute([&]() -> decltype(auto) { return fork_join.run_task(f); });
}

}  // namespace tracer
