// SPDX-License-Identifier: MIT
#include "tracer/base/parallel.h"

#include <atomic>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tracer/base/progress.h"

namespace tracer {
namespace {

TEST(Parallel, ranges_cover_each_element_once) {
  for (const size_t count : {size_t{0}, size_t{1}, size_t{1000}, size_t{12345}}) {
    std::vector<std::atomic<int>> visits(count);
    parallel_for_ranges(0, count, 100, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) ++visits[i];
    });
    for (const auto& visit : visits) EXPECT_EQ(visit, 1);
  }
}

TEST(Parallel, each_index_is_visited_once) {
  std::vector<std::atomic<int>> visits(500);
  parallel_for_each_index(0, visits.size(), [&](size_t i) { ++visits[i]; });
  for (const auto& visit : visits) EXPECT_EQ(visit, 1);
}

TEST(Parallel, exceptions_reach_the_caller) {
  EXPECT_THROW(parallel_for_each_index(0, 100,
                                       [](size_t i) {
                                         if (i == 50) throw Cancelled{};
                                       }),
               Cancelled);
  EXPECT_THROW(parallel_invoke([] { throw Cancelled{}; }, [] {}), Cancelled);
}

TEST(Parallel, work_runs_on_the_number_of_threads_asked_for) {
  for (const int thread_count : {1, 2, 7}) {
    EXPECT_EQ(with_thread_count(thread_count,
                                [] { return oneapi::tbb::this_task_arena::max_concurrency(); }),
              thread_count);
  }
}

TEST(Progress, tells_the_other_side_where_it_is_and_when_to_stop) {
  Progress progress;
  EXPECT_NO_THROW(progress.throw_if_stopped());
  progress.start_stage("reading");
  progress.set_fraction(0.5);
  EXPECT_STREQ(progress.stage(), "reading");
  EXPECT_EQ(progress.fraction(), 0.5f);
  progress.start_stage("building");
  EXPECT_EQ(progress.fraction(), 0);
  progress.request_stop();
  EXPECT_TRUE(progress.stop_requested());
  EXPECT_THROW(progress.throw_if_stopped(), Cancelled);
}

TEST(Parallel, work_on_one_thread_stays_on_the_caller) {
  const auto caller = std::this_thread::get_id();
  std::atomic<int> elsewhere{0};
  std::atomic<int> done{0};
  on_one_thread([&] {
    parallel_for_each_index(0, 1000, [&](size_t) {
      ++done;
      if (std::this_thread::get_id() != caller) ++elsewhere;
    });
  });
  EXPECT_EQ(done, 1000);
  EXPECT_EQ(elsewhere, 0);
}

}  // namespace
}  // namespace tracer
