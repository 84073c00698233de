// SPDX-License-Identifier: MIT
// Lines over two logarithmic axes as SVG.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bench {

/// All positive; the value lies between low and high.
struct LinePoint {
  double x = 1;
  double y = 1;
  double low = 1, high = 1;
};

struct LineSeries {
  std::string label;
  std::string color;
  std::vector<LinePoint> points;  // in the order of x
};

struct LinePanel {
  std::string title;
  std::string note;                // beside the title
  std::vector<LineSeries> series;  // the first is drawn strongest
};

/// Panels lie side by side, two a row, each with axes of its own.
struct LineChart {
  std::string title;
  std::string subtitle;
  std::string footer;
  std::string x_axis;
  std::vector<LinePanel> panels;
};

std::string to_svg(const LineChart& chart);

/// Writes PATH.svg, and PATH.png where rsvg-convert is found; returns the paths of what was
/// written. Throws std::runtime_error.
std::vector<std::filesystem::path> write_chart(const LineChart& chart,
                                               const std::filesystem::path& path);

}  // namespace bench
