// SPDX-License-Identifier: MIT
// Grouped bars as SVG.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/compare/svg.h"

namespace bench {

/// Ours are blue and green, others warm or grey.
struct BarSeries {
  enum class Family { ours, others };
  std::string name;
  Family family = Family::ours;
};

struct Bar {
  size_t series = 0;  // index into BarChart::series
  double height = 0;
  std::string label;  // over the bar
};

struct BarGroup {
  std::string label;  // under the bars
  std::string note;   // below it, in the color of our first series; may be empty
  std::vector<Bar> bars;
};

struct BarPanel {
  std::string title;
  std::string axis;  // what the heights are
  std::vector<BarGroup> groups;
};

/// Panels lie one below the other, each with a scale of its own that begins at 0.
struct BarChart {
  svg::Frame frame;
  std::vector<BarSeries> series;  // in the order of the legend
  std::vector<BarPanel> panels;
  double reference = 0;  // a dashed line at this height; 0: none
};

std::string to_svg(const BarChart& chart);

}  // namespace bench
