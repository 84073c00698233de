// SPDX-License-Identifier: MIT
#include "app/alarm.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace app {
namespace {

void sleep_ms(int duration_ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(duration_ms));
}

TEST(Alarm, rings_once_and_not_before_its_time) {
  std::atomic<int> ring_count{0};
  const auto start = std::chrono::steady_clock::now();
  std::atomic<double> rang_after_seconds{0};
  Alarm alarm([&] {
    rang_after_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++ring_count;
  });
  alarm.set(0.05);
  while (ring_count == 0) sleep_ms(1);
  sleep_ms(100);
  EXPECT_EQ(ring_count, 1);
  EXPECT_GE(rang_after_seconds, 0.05);
}

TEST(Alarm, does_not_ring_when_cleared) {
  std::atomic<int> ring_count{0};
  Alarm alarm([&] { ++ring_count; });
  alarm.set(0.05);
  alarm.clear();
  sleep_ms(150);
  EXPECT_EQ(ring_count, 0);
}

TEST(Alarm, rings_when_it_is_set_earlier_than_it_was) {
  std::atomic<int> ring_count{0};
  Alarm alarm([&] { ++ring_count; });
  alarm.set(1000);
  sleep_ms(20);
  alarm.set(0.01);
  for (int look = 0; look < 5000 && ring_count == 0; ++look) sleep_ms(1);
  EXPECT_EQ(ring_count, 1);
}

}  // namespace
}  // namespace app
