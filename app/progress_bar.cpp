// SPDX-License-Identifier: MIT
#include "app/progress_bar.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <mutex>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace app {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds redraw_interval{100};
constexpr int bar_columns = 30;

int terminal_columns() {
  winsize size{};
  const bool is_known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return is_known ? size.ws_col : 80;
}

std::string duration(double seconds) {
  const auto whole = std::lround(seconds);
  if (whole >= 3600)
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

void draw(const std::string& line) {
  // Back to the line's start, the text, and nothing behind it.
  const std::string text = "\r" + line + "\x1b[K";
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void draw_until_stopped(const std::stop_token& stop, const tracer::Progress& progress) {
  std::mutex mutex;
  std::condition_variable_any stopped;
  std::unique_lock lock(mutex);
  const char* stage = progress.stage();
  Clock::time_point start = Clock::now();
  // The first wait keeps quick work from flashing a bar.
  while (!stopped.wait_for(lock, stop, redraw_interval, [&] { return stop.stop_requested(); })) {
    if (progress.stage() != stage) {
      stage = progress.stage();
      start = Clock::now();
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    draw(progress_line(stage, progress.fraction(), seconds, terminal_columns()));
  }
  draw("");
}

}  // namespace

std::string progress_line(std::string_view stage, double fraction, double seconds, int columns) {
  const double part = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(part * bar_columns);
  const bool is_time_known = part > 0 && seconds >= 0.5;
  const std::string line = fmt::format(
      "{:<18.18} [{:=<{}}{:<{}}] {:3.0f} %{}", stage, "", filled, "", bar_columns - filled,
      100 * part, is_time_known ? "  " + duration(seconds / part * (1 - part)) + " left" : "");
  return line.substr(0, static_cast<size_t>(std::max(columns, 0)));
}

ProgressBar::ProgressBar(const tracer::Progress& progress)
    : drawing_([&progress](const std::stop_token& stop) { draw_until_stopped(stop, progress); }) {}

bool ProgressBar::is_visible() {
  return isatty(STDERR_FILENO) == 1;
}

}  // namespace app
