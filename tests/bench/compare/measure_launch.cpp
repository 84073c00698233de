// SPDX-License-Identifier: MIT
// What a user waits for who opens a model: from starting the program to its picture.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/stopwatch.h"
#include "tests/bench/compare/choose.h"
#include "tests/bench/compare/commands.h"
#include "tests/bench/compare/load_files.h"
#include "tests/bench/compare/machine.h"
#include "tests/bench/compare/report_files.h"
#include "tests/bench/compare/screen_watch.h"
#include "tests/bench/compare/statistics.h"
#include "tests/support/large_meshes.h"
#include "tests/support/run_program.h"

namespace bench {
namespace {

using Path = std::filesystem::path;

constexpr double patience_seconds = 60;

/// A model, and the seconds within which its picture has to show.
struct LaunchTarget {
  std::string_view name;
  std::string_view what;
  double seconds = 0;
  bool is_in_quick = false;
};
constexpr LaunchTarget targets[] = {{"cow", "5,804 triangles", 0.25, true},
                                    {"bunny", "69,451 triangles", 0.35, true},
                                    {"sphere", "a bumpy one of 1,002,252 triangles", 0.9, false}};

struct LaunchRecord {
  std::string model;
  double target_seconds = 0;
  std::vector<double> window_seconds{};   // until anything is on the screen
  std::vector<double> picture_seconds{};  // until the model is
};

nlohmann::json json_of(const std::vector<double>& seconds) {
  const Spread spread = spread_of(seconds);
  return {{"min", spread.min}, {"median", spread.median}, {"max", spread.max}};
}

void to_json(nlohmann::json& json, const LaunchRecord& record) {
  json = {{"model", record.model},
          {"launches", record.picture_seconds.size()},
          {"window_seconds", json_of(record.window_seconds)},
          {"picture_seconds", json_of(record.picture_seconds)},
          {"target_seconds", record.target_seconds}};
}

std::string table_line(const LaunchRecord& record) {
  const Spread picture = spread_of(record.picture_seconds);
  return fmt::format(
      "{:<8} {} launches  window {:.3f} s  traced picture {:.3f} s ({:.3f} - {:.3f})  "
      "target {:.2f} s",
      record.model, record.picture_seconds.size(), spread_of(record.window_seconds).median,
      picture.median, picture.min, picture.max, record.target_seconds);
}

tests::Rectangle middle_of(const tests::Rectangle& area, int size) {
  const int x = (area.x0 + area.x1 - size) / 2, y = (area.y0 + area.y1 - size) / 2;
  return {x, y, x + size, y + size};
}

template <class Condition>
double seconds_until(const app::Stopwatch& stopwatch, const Condition& holds, const char* what) {
  while (!holds()) {
    if (stopwatch.seconds() > patience_seconds) throw std::runtime_error(what);
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
  return stopwatch.seconds();
}

// An empty window is of one color where the model will stand, a traced one of many.
bool shows_model(const ScreenWatch& screen, const tests::Rectangle& middle) {
  return screen.part_of_commonest_color(middle) < 0.3;
}

void launch(const Path& model, const ScreenWatch& screen, const tests::Rectangle& middle,
            LaunchRecord& record) {
  const tests::Rectangle whole{0, 0, 1280, 800};
  const app::Stopwatch closing;
  seconds_until(
      closing, [&] { return screen.part_of_commonest_color(whole) == 1; },
      "the screen does not get empty");
  const uint64_t empty = screen.fingerprint(whole);
  const app::Stopwatch stopwatch;
  const tests::ChildProgram viewer(BOXWOOD_PROGRAM, {"view", "--size", "1280x800", model.string()});
  record.window_seconds.push_back(seconds_until(
      stopwatch, [&] { return screen.fingerprint(whole) != empty; }, "no window shows"));
  record.picture_seconds.push_back(seconds_until(
      stopwatch, [&] { return shows_model(screen, middle); }, "the model does not show"));
}

/// As a user has it; nothing where it is missing.
std::optional<Path> find_model(std::string_view name, const tracer::TemporaryFolder& folder) {
  if (name == "sphere") {
    const Path path = folder / "sphere.obj";
    write_obj(path, tracer::bumpy_sphere(289), CornerContent::positions);  // 1,002,252 triangles
    return path;
  }
  const Path path =
      Path(BOXWOOD_SHARED_DIR "/models") / (name == "cow" ? "cow.obj" : "stanford-bunny.obj");
  return std::filesystem::exists(path) ? std::optional(path) : std::nullopt;
}

// An untimed launch says where the picture stands, and brings the files into memory.
tests::Rectangle find_picture(const Path& model, const tracer::TemporaryFolder& folder) {
  const Path layout_file = folder / "layout.json";
  const tests::ChildProgram viewer(BOXWOOD_PROGRAM, {"view", "--size", "1280x800", "--ui-layout",
                                                     layout_file.string(), model.string()});
  const app::Stopwatch stopwatch;
  std::optional<tests::Rectangle> picture;
  seconds_until(
      stopwatch, [&] { return picture = tests::find_widget(layout_file, "picture"); },
      "the window shows no picture");
  return *picture;
}

}  // namespace

int measure_launch(const Options& options) {
  const tests::VirtualDisplay display;
  if (!display.is_running()) throw std::runtime_error("Xvfb does not start; is it installed?");
  const ScreenWatch screen(display);
  std::vector<LaunchRecord> records;
  fmt::print("{}\n", machine_line());
  for (const LaunchTarget* target : chosen_from(std::span<const LaunchTarget>(targets), options)) {
    const tracer::TemporaryFolder folder;
    const auto model = find_model(target->name, folder);
    if (!model) {
      fmt::print("{}: SKIPPED, its model is missing\n", target->name);
      continue;
    }
    const tests::Rectangle middle = middle_of(find_picture(*model, folder), 120);
    LaunchRecord record{std::string(target->name), target->seconds};
    for (int i = 0; i < options.repeat_count; ++i) launch(*model, screen, middle, record);
    fmt::print("{}\n", table_line(record));
    std::fflush(stdout);
    records.push_back(record);
  }
  if (records.empty()) return 1;
  write_json(options.folder / "launch", records);
  return 0;
}

}  // namespace bench
