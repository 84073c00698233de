// SPDX-License-Identifier: MIT
// What a hand on the mouse waits for, seen from outside: real events in, pixels out.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/stopwatch.h"
#include "tests/bench/compare/commands.h"
#include "tests/bench/compare/mouse.h"
#include "tests/bench/compare/report_files.h"
#include "tests/bench/compare/screen_watch.h"
#include "tests/bench/compare/statistics.h"
#include "tests/bench/compare/viewer_under_test.h"

namespace bench {
namespace {

using tests::Rectangle;

constexpr double patience_seconds = 60;

/// From an event to what it changes on the screen.
struct LatencyRecord {
  std::string scene;
  std::string measure;       // orbit: mouse motion to picture; slider: press to tree statistics
  std::vector<double> ms{};  // one an event
  int unanswered = 0;        // events without an answer
  double pictures_per_second = 0;  // orbit: while the mouse moves 60 times a second
};

void to_json(nlohmann::json& json, const LatencyRecord& record) {
  const Spread spread = spread_of(record.ms);
  json = {{"scene", record.scene},
          {"measure", record.measure},
          {"events", record.ms.size()},
          {"unanswered", record.unanswered},
          {"ms",
           {{"min", spread.min},
            {"median", spread.median},
            {"p95", quantile(record.ms, 0.95)},
            {"max", spread.max}}}};
  if (record.pictures_per_second > 0) json["pictures_per_second"] = record.pictures_per_second;
}

std::string table_line(const LatencyRecord& record) {
  const Spread spread = spread_of(record.ms);
  std::string line = fmt::format(
      "{:<8} {:<7} {:>3} events  median {:>6.1f} ms  95 % within {:>6.1f} ms  ({:.1f} - {:.1f})",
      record.scene, record.measure, record.ms.size(), spread.median, quantile(record.ms, 0.95),
      spread.min, spread.max);
  if (record.pictures_per_second > 0) {
    line += fmt::format("  {:.0f} pictures a second while dragging", record.pictures_per_second);
  }
  if (record.unanswered > 0) line += fmt::format("  {} unanswered", record.unanswered);
  return line;
}

void pause(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

int center_y(const Rectangle& area) {
  return (area.y0 + area.y1) / 2;
}

void move_to_part(Mouse& mouse, const Rectangle& slider, double part) {
  mouse.move_to(slider.x0 + static_cast<int>(part * (slider.x1 - slider.x0)), center_y(slider));
}

void require_still(const ScreenWatch& screen, const Rectangle& area, double still_seconds) {
  if (!screen.wait_until_still(area, still_seconds, patience_seconds)) {
    throw std::runtime_error("the window does not come to rest");
  }
}

// One sample a pixel, so that each picture is soon done and only an event can change it.
void limit_samples(const ViewerUnderTest& viewer, Mouse& mouse) {
  move_to_part(mouse, viewer.widget("sample-limit"), 0.01);
  mouse.press();
  pause(0.1);
  mouse.release();
  pause(0.1);
}

// Where a machine is so busy that the window sees two events as one, an answer may never come.
void measure_answer(const ScreenWatch& screen, const Rectangle& area, LatencyRecord& record,
                    const std::function<void()>& send_event) {
  constexpr double longest_seconds = 5;
  const uint64_t before = screen.fingerprint(area);
  const app::Stopwatch stopwatch;
  send_event();
  if (screen.seconds_to_change(area, before, longest_seconds)) {
    record.ms.push_back(1000 * stopwatch.seconds());
  } else {
    ++record.unanswered;
  }
}

/// Drags back and forth over the picture.
class Orbit {
 public:
  Orbit(Mouse& mouse, const Rectangle& picture)
      : mouse_(mouse), x_((picture.x0 + picture.x1) / 2), y_(center_y(picture)) {
    mouse_.move_to(x_, y_);
    mouse_.press();
  }
  ~Orbit() { mouse_.release(); }
  Orbit(const Orbit&) = delete;
  Orbit& operator=(const Orbit&) = delete;

  void step() {
    constexpr int steps_one_way = 15;
    const int direction = step_++ / steps_one_way % 2 == 0 ? 1 : -1;
    mouse_.move_to(x_ += 9 * direction, y_ += 2 * direction);
  }

 private:
  Mouse& mouse_;
  int x_, y_;
  int step_ = 0;
};

double pictures_per_second(const ScreenWatch& screen, const Rectangle& picture, Orbit& orbit) {
  constexpr int motion_count = 180;
  constexpr double interval_seconds = 1.0 / 60;
  int change_count = 0;
  const app::Stopwatch stopwatch;
  for (int motion = 1; motion <= motion_count; ++motion) {
    orbit.step();
    while (stopwatch.seconds() < motion * interval_seconds) {
      const double left = motion * interval_seconds - stopwatch.seconds();
      if (screen.seconds_to_change(picture, screen.fingerprint(picture), left)) ++change_count;
    }
  }
  return change_count / stopwatch.seconds();
}

LatencyRecord measure_dragging(const std::string& scene, const ViewerUnderTest& viewer,
                               const ScreenWatch& screen, Mouse& mouse, int event_count) {
  const Rectangle picture = viewer.widget("picture");
  LatencyRecord record{scene, "orbit"};
  Orbit orbit(mouse, picture);
  for (int event = 0; event < event_count; ++event) {
    require_still(screen, picture,
                  0.06 + 0.0011 * (event % 16));  // in step with no clock of theirs
    measure_answer(screen, picture, record, [&] { orbit.step(); });
  }
  record.pictures_per_second = pictures_per_second(screen, picture, orbit);
  return record;
}

// The tree never changes the picture: its counts in the panel say that the new one is traced. They
// are the first rows; what is measured of a tree later on stands below them.
Rectangle tree_counts(const ViewerUnderTest& viewer) {
  constexpr int row_count = 4;
  const Rectangle heading = viewer.widget("section Statistics");
  const Rectangle row = viewer.widget("rate");
  return {heading.x0, heading.y1, heading.x1, heading.y1 + row_count * (row.y1 - row.y0)};
}

LatencyRecord measure_slider(const std::string& scene, const ViewerUnderTest& viewer,
                             const ScreenWatch& screen, Mouse& mouse, int event_count) {
  const Rectangle slider = viewer.widget("leaf-size");
  const Rectangle counts = tree_counts(viewer);
  LatencyRecord record{scene, "slider"};
  for (int event = 0; event < event_count; ++event) {
    move_to_part(mouse, slider, event % 2 == 0 ? 0.3 : 0.1);
    require_still(screen, counts, 0.2 + 0.0011 * (event % 16));
    measure_answer(screen, counts, record, [&] { mouse.press(); });
    require_still(screen, counts, 0.1);
    mouse.release();
    pause(0.1);
  }
  return record;
}

void write_obj(const std::filesystem::path& path, const tracer::Mesh& mesh) {
  std::ofstream file(path);
  for (const tracer::Vec3f& position : mesh.positions) {
    file << fmt::format("v {} {} {}\n", position.x, position.y, position.z);
  }
  for (const tracer::Vec3u& triangle : mesh.triangles) {
    file << fmt::format("f {} {} {}\n", triangle.x + 1, triangle.y + 1, triangle.z + 1);
  }
}

std::vector<LatencyRecord> measure_scene(const Scene& scene, const tests::VirtualDisplay& display,
                                         Effort effort) {
  const tests::TemporaryFolder folder;
  const std::filesystem::path model = folder / fmt::format("{}.obj", scene.name);
  write_obj(model, *scene.mesh);
  const ViewerUnderTest viewer(model);
  const ScreenWatch screen(display);
  Mouse mouse;
  viewer.widget("model");
  limit_samples(viewer, mouse);
  require_still(screen, viewer.widget("picture"), 0.5);
  const std::string name(scene.name);
  const bool is_quick = effort == Effort::quick;
  return {measure_dragging(name, viewer, screen, mouse, is_quick ? 15 : 80),
          measure_slider(name, viewer, screen, mouse, is_quick ? 6 : 24)};
}

// The scenes with a target, unless others are named.
Options with_orbit_scenes(Options options) {
  if (options.scenes.empty()) options.scenes = {"cow", "bunny", "sphere"};
  return options;
}

}  // namespace

int measure_orbit(const Options& options) {
  const tests::VirtualDisplay display;
  if (!display.is_running()) throw std::runtime_error("Xvfb does not start; is it installed?");
  std::vector<LatencyRecord> records;
  for (const SceneEntry* entry : chosen_scenes(with_orbit_scenes(options))) {
    const auto scene = make_scene(*entry, options.effort);
    if (!scene) continue;
    for (const LatencyRecord& record : measure_scene(*scene, display, options.effort)) {
      fmt::print("{}\n", table_line(record));
      std::fflush(stdout);
      records.push_back(record);
    }
  }
  if (records.empty()) return 1;
  fmt::print(
      "targets: orbit 33 ms, 95 % within 50 ms; slider 16 ms on the bunny, 150 ms on the sphere\n");
  write_json(options.folder / "orbit", records);
  return 0;
}

}  // namespace bench
