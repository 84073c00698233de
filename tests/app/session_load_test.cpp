// SPDX-License-Identifier: MIT
#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/app/session_fixture.h"

namespace app {
namespace {

namespace fs = std::filesystem;

TEST_F(SessionTest, the_newest_load_wins) {
  const fs::path large = ball("large.obj", 200);
  const fs::path small = ball("small.obj", 12);
  session_->set(edits_);
  session_->open(large);
  session_->open(small);
  ASSERT_TRUE(wait_until([this] { return status_.model && !status_.is_loading && is_done(); }));
  EXPECT_EQ(status_.model_path, small.string());
  EXPECT_EQ(status_.error, "");
}

TEST_F(SessionTest, a_failed_load_keeps_the_model) {
  ASSERT_TRUE(show(ball("ball.obj", 12)));
  const auto before = picture_.pixels;
  session_->open(folder_ / "missing.obj");
  ASSERT_TRUE(wait_until([this] { return !status_.is_loading && !status_.error.empty(); }));
  EXPECT_NE(status_.error.find("missing.obj"), std::string::npos);
  EXPECT_EQ(status_.model_path, (folder_ / "ball.obj").string());
  EXPECT_TRUE(is_done());
  EXPECT_EQ(picture_.pixels, before);
  session_->open(folder_ / "ball.obj");
  ASSERT_TRUE(wait_until([this] { return status_.model_generation == 2 && is_done(); }));
  EXPECT_EQ(status_.error, "");
}

TEST_F(SessionTest, an_error_that_comes_again_is_a_new_one) {
  for (uint64_t attempt = 1; attempt <= 3; ++attempt) {
    session_->open(folder_ / "missing.obj");
    ASSERT_TRUE(wait_until([&] { return status_.error_generation == attempt; }));
    EXPECT_NE(status_.error.find("missing.obj"), std::string::npos);
  }
}

TEST_F(SessionTest, a_cancelled_load_keeps_the_model) {
  ASSERT_TRUE(show(ball("ball.obj", 12)));
  const fs::path large = ball("large.obj", 300);
  session_->open(large);
  session_->cancel_job();
  ASSERT_TRUE(wait_until([this] { return !status_.is_loading; }));
  EXPECT_EQ(status_.model_path, (folder_ / "ball.obj").string());
  EXPECT_EQ(status_.error, "");
}

TEST_F(SessionTest, a_model_is_not_traced_before_its_camera_is_set) {
  session_->set(edits_);
  session_->open(ball("ball.obj", 12));
  const auto start = Clock::now();
  Update update;
  do {
    update = session_->poll();
  } while (!update.status.model && seconds_since(start) < 60);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  update = session_->poll();
  EXPECT_EQ(update.status.rays, 0u);
  EXPECT_TRUE(update.tiles.empty());
}

TEST_F(SessionTest, ends_promptly_whatever_it_is_doing) {
  const fs::path large = ball("large.obj", 200);
  edits_.size_px = {1280, 720};
  edits_.builder = nullptr;
  for (const int delay_ms : {0, 5, 50, 300, 900}) {
    session_->set(edits_);
    session_->open(large);
    edits_.model_generation = 0;
    const auto start = Clock::now();
    while (seconds_since(start) < 1e-3 * delay_ms) {
      poll();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const auto end = Clock::now();
    session_.reset();
    EXPECT_LT(seconds_since(end), 1.0) << "after " << delay_ms << " ms";
    RecordProperty("after_" + std::to_string(delay_ms) + "_ms",
                   static_cast<int>(1000 * seconds_since(end)));
    edits_.model_generation = 0;
    session_ = std::make_unique<Session>([] {});
  }
}

TEST(Session, wakes_once_between_two_polls) {
  std::atomic<int> wake_count{0};
  const fs::path path = fs::temp_directory_path() / ("boxwood-wake-" + std::to_string(getpid()));
  tests::write_ball(path, 12);
  Session session([&] { ++wake_count; });
  const Edits edits;
  session.set(edits);
  session.open(path);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(wake_count, 1);
  fs::remove(path);
}

}  // namespace
}  // namespace app
