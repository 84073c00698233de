// SPDX-License-Identifier: MIT
#include "app/progress_bar.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(ProgressLine, says_stage_part_and_time_left) {
  const std::string line = progress_line("rendering", 0.25, 10, 80);
  EXPECT_NE(line.find("rendering"), std::string::npos) << line;
  EXPECT_NE(line.find("25 %"), std::string::npos) << line;
  EXPECT_NE(line.find("0:30 left"), std::string::npos) << line;
}

TEST(ProgressLine, hours_are_written_as_such) {
  EXPECT_NE(progress_line("rendering", 0.5, 3725, 80).find("1:02:05 left"), std::string::npos);
}

TEST(ProgressLine, promises_no_time_before_anything_is_known) {
  EXPECT_EQ(progress_line("loading", 0, 100, 80).find("left"), std::string::npos);
  EXPECT_EQ(progress_line("loading", 0.001, 0.01, 80).find("left"), std::string::npos);
}

TEST(ProgressLine, the_bar_fills_with_the_part_done_and_keeps_its_width) {
  size_t filled_before = 0;
  for (const double fraction : {-1.0, 0.0, 0.3, 0.6, 1.0, 2.0}) {
    const std::string line = progress_line("rendering", fraction, 0, 80);
    const auto filled = static_cast<size_t>(std::count(line.begin(), line.end(), '='));
    EXPECT_GE(filled, filled_before);
    EXPECT_EQ(line.size(), progress_line("rendering", 0.5, 0, 80).size());
    filled_before = filled;
  }
}

TEST(ProgressLine, never_wraps_around_the_terminal) {
  for (const int columns : {0, 1, 20, 40}) {
    EXPECT_LE(progress_line("building the tree", 0.5, 1e6, columns).size(),
              static_cast<size_t>(columns));
  }
}

}  // namespace
}  // namespace app
