// SPDX-License-Identifier: MIT
// Grouped bars as SVG.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bench {

struct Bar {
  size_t series = 0;  // index into BarChart::series
  double height = 0;
  std::string label;  // over the bar
};

struct BarGroup {
  std::string label;  // under the bars
  std::string note;   // below it, in the color of the first series; may be empty
  std::vector<Bar> bars;
};

struct BarPanel {
  std::string title;
  std::string axis;  // what the heights are
  std::vector<BarGroup> groups;
};

/// Panels lie one below the other, each with a scale of its own that begins at 0.
struct BarChart {
  std::string title;
  std::string subtitle;
  std::string footer;
  std::vector<std::string> series;  // names, for the legend; at most 8
  std::vector<BarPanel> panels;
  double reference = 0;  // a dashed line at this height; 0: none
};

std::string to_svg(const BarChart& chart);

/// Writes PATH.svg, and PATH.png where rsvg-convert is found; returns the paths of what was
/// written. Throws std::runtime_error.
std::vector<std::filesystem::path> write_chart(const BarChart& chart,
                                               const std::filesystem::path& path);

}  // namespace bench
