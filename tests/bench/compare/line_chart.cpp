// SPDX-License-Identifier: MIT
#include "tests/bench/compare/line_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "tests/bench/compare/log_axis.h"

namespace bench {
namespace {

using svg::Anchor;
using svg::line;
using svg::text;

constexpr double width = svg::page_width;
constexpr double margin = svg::page_margin;
constexpr double axis_width = 46;
constexpr double header_height = 112;
constexpr double panel_height = 380;
constexpr double panel_gap = 30;
constexpr double panel_head = 50;
constexpr double panel_foot = 32;
constexpr double footer_height = 56;
constexpr const char* quiet = "#666666";

struct Place {
  Rectangle plot;
  LogScale x, y;
};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = 0;

  void take(double value) { low = std::min(low, value), high = std::max(high, value); }
};

Place place_of(const LinePanel& panel, double left, double top) {
  Range x, y;
  for (const LineSeries& series : panel.series) {
    for (const LinePoint& point : series.points) x.take(point.x), y.take(point.y);
  }
  if (x.high == 0) x = y = {1, 10};
  const double panel_width = (width - 2 * margin - panel_gap) / 2;
  Place place;
  place.plot = {left + axis_width, top + panel_head, left + panel_width,
                top + panel_height - panel_foot};
  place.x = {x.low / 1.15, x.high * 1.15, place.plot.left, place.plot.right};
  place.y = {std::pow(10, std::floor(std::log10(y.low))),
             std::pow(10, std::ceil(std::log10(y.high))), place.plot.bottom, place.plot.top};
  return place;
}

std::string series_svg(const LineSeries& series, const Place& place, double stroke) {
  std::string band, path, back;
  for (const LinePoint& point : series.points) {
    const char* step = path.empty() ? "M" : "L";
    path += fmt::format("{}{:.1f} {:.1f} ", step, place.x(point.x), place.y(point.y));
    band += fmt::format("{}{:.1f} {:.1f} ", step, place.x(point.x),
                        place.y(std::clamp(point.high, place.y.low, place.y.high)));
    back = fmt::format("L{:.1f} {:.1f} ", place.x(point.x),
                       place.y(std::clamp(point.low, place.y.low, place.y.high))) +
           back;
  }
  std::string drawn = fmt::format(
      "<path d=\"{0}{1}z\" fill=\"{2}\" fill-opacity=\"0.15\"/>\n<path d=\"{3}\" fill=\"none\" "
      "stroke=\"{2}\" stroke-width=\"{4}\" stroke-linejoin=\"round\"/>\n",
      band, back, series.color, path, stroke);
  for (const LinePoint& point : series.points) {
    drawn += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n",
                         place.x(point.x), place.y(point.y), stroke + 0.5, series.color);
  }
  return drawn;
}

std::string panel_svg(const LinePanel& panel, double left, double top) {
  const Place place = place_of(panel, left, top);
  std::string drawn =
      text(place.plot.left, top + 20, {.size = 16, .weight = "bold"}, panel.title) +
      text(place.plot.left, top + 40, {.size = 13, .color = "#333333"}, panel.note) +
      x_axis(place.plot, place.x) + y_axis(place.plot, place.y);
  // The strongest comes last, over the others.
  for (size_t i = panel.series.size(); i-- > 0;) {
    if (!panel.series[i].points.empty()) {
      drawn += series_svg(panel.series[i], place, i == 0 ? 3 : 1.8);
    }
  }
  return drawn;
}

std::string legend(const LineChart& chart) {
  std::vector<std::pair<std::string, std::string>> entries;
  for (const LinePanel& panel : chart.panels) {
    for (const LineSeries& series : panel.series) {
      const std::pair entry(series.label, series.color);
      if (std::ranges::find(entries, entry) == entries.end()) entries.push_back(entry);
    }
  }
  std::string drawn;
  double x = margin;
  for (const auto& [label, color] : entries) {
    drawn += line(x, 92, x + 22, 92, fmt::format("stroke=\"{}\" stroke-width=\"4\"", color));
    drawn += text(x + 30, 97, {.size = 14}, label);
    x += 58 + 8.4 * static_cast<double>(label.size());
  }
  return drawn;
}

}  // namespace

std::string to_svg(const LineChart& chart) {
  std::string drawn = legend(chart);
  double y = header_height;
  for (size_t i = 0; i < chart.panels.size(); ++i) {
    const bool is_right = i % 2 == 1;
    drawn += panel_svg(chart.panels[i], is_right ? (width + panel_gap) / 2 : margin, y);
    if (is_right || i + 1 == chart.panels.size()) y += panel_height;
  }
  drawn += text(width - margin, y + 8, {.size = 13, .color = quiet, .anchor = Anchor::end},
                chart.x_axis);
  const double height = y + footer_height;
  return svg::page(height, chart.frame, drawn);
}

}  // namespace bench
