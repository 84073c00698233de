// SPDX-License-Identifier: MIT
// Lines over two logarithmic axes as SVG.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/compare/svg.h"

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
  svg::Frame frame;
  std::string x_axis;
  std::vector<LinePanel> panels;
};

std::string to_svg(const LineChart& chart);

}  // namespace bench
