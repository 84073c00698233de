// SPDX-License-Identifier: MIT
// What a hand on the mouse waits for, seen from outside: real events in, pixels out.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/stopwatch.h"
#include "tests/bench/compare/choose.h"
#include "tests/bench/compare/commands.h"
#include "tests/bench/compare/load_files.h"
#include "tests/bench/compare/mouse.h"
#include "tests/bench/compare/report_files.h"
#include "tests/bench/compare/screen_watch.h"
#include "tests/bench/compare/viewer_under_test.h"
#include "tests/bench/compare/window_records.h"

namespace bench {
namespace {

using tests::Rectangle;

constexpr double patience_seconds = 60;

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

void click_slider(Mouse& mouse, const Rectangle& slider, double part) {
  move_to_part(mouse, slider, part);
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

LatencyRecord measure_orbiting(const std::string& scene, const ViewerUnderTest& viewer,
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

// Frames are seen by what is set: each motion sets another value. Of the slider a row of pixels
// above its letters is watched, as the server may be in the midst of copying what is taller.
FrameRate watch_drag(const ScreenWatch& screen, const Rectangle& slider, Mouse& mouse,
                     double seconds) {
  constexpr double interval_seconds = 1.0 / 250;  // of a common mouse
  constexpr double sweep_seconds = 0.6;           // from one end to the other, and from there again
  const Rectangle row{slider.x0, slider.y0 + 2, slider.x1, slider.y0 + 3};
  std::vector<double> times;
  uint64_t shown = screen.fingerprint(row);
  const app::Stopwatch stopwatch;
  mouse.press();
  for (int motion = 1; motion * interval_seconds < seconds; ++motion) {
    const double sweep = motion * interval_seconds / sweep_seconds;
    move_to_part(mouse, slider, 0.1 + 0.8 * (sweep - std::floor(sweep)));
    while (stopwatch.seconds() < motion * interval_seconds) {
      const double left = motion * interval_seconds - stopwatch.seconds();
      if (!screen.seconds_to_change(row, shown, left)) continue;
      times.push_back(stopwatch.seconds());
      shown = screen.fingerprint(row);
    }
  }
  const double end_seconds = stopwatch.seconds();
  mouse.release();
  return frame_rate_of(times, end_seconds);
}

DragRecord measure_drag(const std::string& scene, const std::string& measure,
                        const ViewerUnderTest& viewer, const ScreenWatch& screen, Mouse& mouse,
                        int drag_count) {
  constexpr double drag_seconds = 2;
  const Rectangle slider = viewer.widget("leaf-size");
  DragRecord record{scene, measure};
  for (int drag = 0; drag < drag_count; ++drag) {
    move_to_part(mouse, slider, 0.05);
    pause(1 + 0.0011 * drag);  // the tree of the drag before is done, or well under way
    record.rates.push_back(watch_drag(screen, slider, mouse, drag_seconds));
  }
  return record;
}

/// Adds records, and prints each as soon as it is there.
class Report {
 public:
  template <class Record>
  void add(const Record& record) {
    fmt::print("{}\n", table_line(record));
    std::fflush(stdout);
    records_.push_back(record);
  }
  const nlohmann::json& records() const { return records_; }

 private:
  nlohmann::json records_ = nlohmann::json::array();
};

void measure_scene(const Scene& scene, const tests::VirtualDisplay& display, Effort effort,
                   Report& report) {
  const tests::TemporaryFolder folder;
  const std::filesystem::path model = folder / fmt::format("{}.obj", scene.name);
  write_obj(model, *scene.mesh, CornerContent::positions);
  const ViewerUnderTest viewer(model);
  const ScreenWatch screen(display);
  Mouse mouse;
  viewer.widget("model");
  const std::string name(scene.name);
  const bool is_quick = effort == Effort::quick;
  const Rectangle sample_limit = viewer.widget("sample-limit");
  click_slider(mouse, sample_limit, 0.99);
  report.add(measure_drag(name, "resolving", viewer, screen, mouse, is_quick ? 2 : 7));
  // One sample a pixel, so that each picture is soon done and only an event can change it.
  click_slider(mouse, sample_limit, 0.01);
  require_still(screen, viewer.widget("picture"), 0.5);
  report.add(measure_drag(name, "drag", viewer, screen, mouse, is_quick ? 2 : 7));
  report.add(measure_orbiting(name, viewer, screen, mouse, is_quick ? 15 : 80));
  report.add(measure_slider(name, viewer, screen, mouse, is_quick ? 6 : 24));
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
  Report report;
  for (const SceneEntry* entry : chosen_from(scene_entries(), with_orbit_scenes(options))) {
    const auto scene = make_scene(*entry, options.effort);
    if (!scene) continue;
    measure_scene(*scene, display, options.effort, report);
  }
  if (report.records().empty()) return 1;
  fmt::print(
      "targets: orbit 33 ms, 95 % within 50 ms; slider 16 ms on the bunny, 150 ms on the sphere; "
      "60 frames a second, the window's limit, while a slider is dragged\n");
  write_json(options.folder / "orbit", report.records());
  return 0;
}

}  // namespace bench
