// SPDX-License-Identifier: MIT
// What was measured of the window, as JSON and as a table.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace bench {

/// From an event to what it changes on the screen.
struct LatencyRecord {
  std::string scene;
  std::string measure;             // orbit: mouse motion to picture; slider: press to tree counts
  std::vector<double> ms{};        // one an event
  int unanswered = 0;              // events without an answer
  double pictures_per_second = 0;  // orbit: while the mouse moves 60 times a second
};

/// How steadily a window shows new frames.
struct FrameRate {
  double frames_per_second = 0;
  double longest_gap_ms = 0;  // between two frames, or one and the begin or end
};

/// Of frames shown at `times`, in seconds since it began and in order; it ended at `end_seconds`,
/// above 0.
FrameRate frame_rate_of(std::span<const double> times, double end_seconds);

/// The window's frames while a hand drags a setting of the tree.
struct DragRecord {
  std::string scene;
  std::string measure;  // drag: of a finished picture; resolving: of one that goes on resolving
  std::vector<FrameRate> rates{};  // one a drag
};

void to_json(nlohmann::json& json, const LatencyRecord& record);
void to_json(nlohmann::json& json, const DragRecord& record);

std::string table_line(const LatencyRecord& record);
std::string table_line(const DragRecord& record);

}  // namespace bench
