// SPDX-License-Identifier: MIT
// Points on two logarithmic axes as SVG, with a band of its own for zero.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/compare/svg.h"

namespace bench {

enum class Marker { disc, ring, diamond };

struct ScatterPoint {
  std::string label;
  std::string color;
  Marker marker = Marker::disc;
  double x = 1;  // positive
  double y = 0;  // 0: in the band
};

struct ScatterPanel {
  std::string title;
  std::string zero;  // what a point in the band says; no band where this is empty
  std::vector<ScatterPoint> points;
};

struct MarkerMeaning {
  Marker marker;
  std::string meaning;
};

/// Panels lie one below the other over the same x axis. Lower left is better: what another point of
/// the panel beats on both axes lies in the shade behind the front.
struct ScatterChart {
  svg::Frame frame;
  std::string x_axis;
  std::vector<MarkerMeaning> markers;
  std::vector<ScatterPanel> panels;
};

/// The points that no other beats on both axes, in the order of x.
std::vector<ScatterPoint> front_of(std::vector<ScatterPoint> points);

std::string to_svg(const ScatterChart& chart);

}  // namespace bench
