// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/run_program.h"
#include "tests/support/virtual_display.h"
#include "tests/support/widget_layout.h"

namespace tests {

/// Runs the real program in a window of its own display, moves the real mouse, looks at pixels.
class WindowTest : public testing::Test {
 protected:
  static constexpr int width_px = 760, height_px = 800;  // of the window

  void SetUp() override {
    if (find_program("Xvfb").empty()) GTEST_SKIP() << "Xvfb is not installed";
    if (find_program("xdotool").empty()) GTEST_SKIP() << "xdotool is not installed";
    display_ = std::make_unique<VirtualDisplay>();
    if (!display_->is_running()) GTEST_SKIP() << "Xvfb does not start";
    setenv("BOXWOOD_UI_LAYOUT", (folder_ / "layout.json").c_str(), 1);
  }

  /// Opens a window smaller than the screen, so that pictures are soon traced under sanitizers.
  void start(const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"view", "--size", fmt::format("{}x{}", width_px, height_px)};
    all.insert(all.end(), arguments.begin(), arguments.end());
    program_ =
        std::make_unique<ChildProgram>(BOXWOOD_PROGRAM, all, ErrorStream::pipe, folder_.path());
  }

  /// Waits, generously for sanitizers, and a moment between two looks.
  static testing::AssertionResult wait_until(const std::function<bool()>& is_reached) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::minutes(2);
    while (Clock::now() < end) {
      if (is_reached()) return testing::AssertionSuccess();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return testing::AssertionFailure() << "not reached within two minutes";
  }

  std::optional<Rectangle> find_widget(const std::string& name) const {
    return tests::find_widget(folder_ / "layout.json", name);
  }
  testing::AssertionResult wait_for_widget(const std::string& name) const {
    return wait_until([&] { return find_widget(name).has_value(); }) << " widget " << name;
  }

  static void xdotool(const std::vector<std::string>& arguments) {
    const ProgramResult result = ChildProgram(find_program("xdotool"), arguments).wait();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  static void move_to(int x, int y) {
    xdotool({"mousemove", std::to_string(x), std::to_string(y)});
  }
  static void press_key(const std::string& key) { xdotool({"key", key}); }

  /// Puts the mouse at a part of the widget's width.
  void move_to(const std::string& name, double part = 0.5) {
    ASSERT_TRUE(wait_for_widget(name));
    const Rectangle at = *find_widget(name);
    move_to(at.x0 + static_cast<int>(part * (at.x1 - at.x0)), (at.y0 + at.y1) / 2);
  }
  void click(const std::string& name, double part = 0.5) {
    move_to(name, part);
    xdotool({"mousedown", "1"});
    xdotool({"mouseup", "1"});
  }
  static void drag(int from_x, int from_y, int to_x, int to_y) {
    move_to(from_x, from_y);
    xdotool({"mousedown", "1"});
    move_to((from_x + to_x) / 2, (from_y + to_y) / 2);
    move_to(to_x, to_y);
    xdotool({"mouseup", "1"});
  }

  /// Pixels of a widget as they are on the screen.
  std::vector<uint32_t> look_at(const Rectangle& area) const {
    const Screen screen = display_->capture();
    std::vector<uint32_t> pixels;
    for (int y = area.y0; y < std::min(area.y1, screen.height); ++y) {
      const auto row = screen.pixels.begin() + static_cast<ptrdiff_t>(y) * screen.width;
      pixels.insert(pixels.end(), row + area.x0, row + std::min(area.x1, screen.width));
    }
    return pixels;
  }
  std::vector<uint32_t> look_at(const std::string& name) const {
    const auto area = find_widget(name);
    return area ? look_at(*area) : std::vector<uint32_t>();
  }

  /// Waits until the picture is done, and it and the panel have stood still for most of a second.
  testing::AssertionResult wait_until_settled() const {
    using Clock = std::chrono::steady_clock;
    auto before = display_->capture().pixels;
    auto still_since = Clock::now();
    return wait_until([&] {
      auto now = display_->capture().pixels;
      if (now != before || !find_widget("finished picture")) still_since = Clock::now();
      before = std::move(now);
      return Clock::now() - still_since > std::chrono::milliseconds(800);
    });
  }

  double cpu_seconds() const {
    std::ifstream file("/proc/" + std::to_string(program_->pid()) + "/stat");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    std::istringstream fields(text.substr(text.rfind(')') + 2));
    std::string skipped;
    for (int i = 0; i < 11; ++i) fields >> skipped;
    double user_ticks = 0, system_ticks = 0;
    fields >> user_ticks >> system_ticks;
    return (user_ticks + system_ticks) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }

  TemporaryFolder folder_;
  std::unique_ptr<VirtualDisplay> display_;
  std::unique_ptr<ChildProgram> program_;
};

}  // namespace tests
