// SPDX-License-Identifier: MIT
#include "tests/bench/compare/scatter_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "tests/bench/compare/log_axis.h"
#include "tests/bench/compare/place_labels.h"

namespace bench {
namespace {

using svg::Anchor;
using svg::line;
using svg::rectangle;
using svg::text;

constexpr double width = svg::page_width;
constexpr double margin = svg::page_margin;
constexpr double axis_width = 62;
constexpr double header_height = 116;
constexpr double panel_height = 330;
constexpr double panel_head = 42;
constexpr double panel_foot = 22;
constexpr double band_height = 62;
constexpr double footer_height = 64;
constexpr const char* quiet = "#666666";

struct Place {
  Rectangle plot;
  LogScale x, y;
  double zero;  // the middle of the band

  double y_of(double value) const { return value > 0 ? y(value) : zero; }
};

std::string marker(Marker kind, double x, double y, const std::string& color) {
  if (kind == Marker::diamond) {
    return fmt::format(
        "<path d=\"M{0:.1f} {1:.1f} l{2} {2} l-{2} {2} l-{2} -{2} z\" fill=\"{3}\" "
        "stroke=\"#FFFFFF\" stroke-width=\"1\"/>\n",
        x, y - marker_radius - 1, marker_radius + 1, color);
  }
  const bool is_ring = kind == Marker::ring;
  return fmt::format(
      "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\" stroke=\"{}\" "
      "stroke-width=\"{}\"/>\n",
      x, y, is_ring ? marker_radius - 1 : marker_radius, is_ring ? "#FFFFFF" : color,
      is_ring ? color : "#FFFFFF", is_ring ? 2.5 : 1);
}

// A little beyond what `values` holds, 1 to 10 where it holds nothing.
std::pair<double, double> range_of(const std::vector<double>& values, double step) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const double value : values) {
    if (value > 0) low = std::min(low, value), high = std::max(high, value);
  }
  if (high == 0) return {1, 10};
  return {low / step, high * step};
}

std::pair<double, double> x_range_of(const ScatterChart& chart) {
  std::vector<double> values;
  for (const ScatterPanel& panel : chart.panels) {
    for (const ScatterPoint& point : panel.points) values.push_back(point.x);
  }
  return range_of(values, 1.35);
}

// Whole decades.
std::pair<double, double> y_range_of(const ScatterPanel& panel) {
  std::vector<double> values;
  for (const ScatterPoint& point : panel.points) values.push_back(point.y);
  const auto [low, high] = range_of(values, 1.5);
  return {std::pow(10, std::floor(std::log10(low))), std::pow(10, std::ceil(std::log10(high)))};
}

Place place_of(const ScatterPanel& panel, std::pair<double, double> x_range, double top) {
  const auto [y_low, y_high] = y_range_of(panel);
  Place place;
  place.plot = {margin + axis_width, top + panel_head, width - margin,
                top + panel_height - panel_foot};
  const double band = panel.zero.empty() ? 0 : band_height;
  place.zero = place.plot.bottom - band / 2;
  place.x = {x_range.first, x_range.second, place.plot.left, place.plot.right};
  place.y = {y_low, y_high, place.plot.bottom - band, place.plot.top};
  return place;
}

std::string zero_band(const ScatterPanel& panel, const Place& place) {
  if (panel.zero.empty()) return "";
  const double top = place.plot.bottom - band_height;
  return rectangle(place.plot.left, top, place.plot.right - place.plot.left, band_height,
                   "#E8F3EC") +
         text(place.plot.left - 8, place.zero + 4,
              {.size = 13, .color = "#2E6B45", .anchor = Anchor::end, .weight = "bold"}, "0") +
         text(place.plot.right, place.plot.top - 12,
              {.size = 13, .color = "#2E6B45", .anchor = Anchor::end}, panel.zero);
}

// Stairs through the front, and the shade above and right of them.
std::string front(const ScatterPanel& panel, const Place& place) {
  std::string stairs;
  const std::vector<ScatterPoint> points = front_of(panel.points);
  if (points.empty()) return "";
  stairs = fmt::format("M{:.1f} {:.1f}", place.x(points.front().x), place.plot.top);
  for (const ScatterPoint& point : points) {
    stairs += fmt::format(" H{:.1f} V{:.1f}", place.x(point.x), place.y_of(point.y));
  }
  stairs += fmt::format(" H{:.1f}", place.plot.right);
  return fmt::format(
      "<path d=\"{0} V{1:.1f} z\" fill=\"#000000\" fill-opacity=\"0.035\"/>\n"
      "<path d=\"{0}\" fill=\"none\" stroke=\"#777777\" stroke-width=\"1.5\" "
      "stroke-dasharray=\"5 4\"/>\n",
      stairs, place.plot.top);
}

// A line to labels that are not beside their point.
std::string leader(const LabelledPoint& point, const Rectangle& label, const std::string& color) {
  const double middle = (label.top + label.bottom) / 2;
  const double x = std::clamp(point.x, label.left, label.right);
  if (std::abs(middle - point.y) < label_size) return "";
  const double y = middle > point.y ? label.top : label.bottom;
  return line(point.x, point.y, x, y, fmt::format("stroke=\"{}\" stroke-width=\"1\"", color));
}

std::string points_of(const ScatterPanel& panel, const Place& place) {
  std::vector<LabelledPoint> labelled;
  for (const ScatterPoint& point : panel.points) {
    labelled.push_back({place.x(point.x), place.y_of(point.y), point.label});
  }
  const std::vector<Rectangle> labels = place_labels(labelled, place.plot);
  std::string leaders, markers, names;
  for (size_t i = 0; i < labelled.size(); ++i) {
    const ScatterPoint& point = panel.points[i];
    leaders += leader(labelled[i], labels[i], point.color);
    markers += marker(point.marker, labelled[i].x, labelled[i].y, point.color);
    // A label left of its point ends there, whatever its width.
    const bool is_left = labels[i].right < labelled[i].x;
    names += text(is_left ? labels[i].right : labels[i].left, labels[i].bottom - 4,
                  {.size = label_size,
                   .color = point.color.c_str(),
                   .anchor = is_left ? Anchor::end : Anchor::start},
                  point.label);
  }
  return leaders + markers + names;
}

std::string panel_svg(const ScatterPanel& panel, std::pair<double, double> x_range, double top) {
  const Place place = place_of(panel, x_range, top);
  return text(margin, top + 24, {.size = 17, .weight = "bold"}, panel.title) +
         zero_band(panel, place) + x_axis(place.plot, place.x) + y_axis(place.plot, place.y) +
         front(panel, place) + points_of(panel, place);
}

std::string legend(const ScatterChart& chart) {
  std::string drawn;
  double x = margin + marker_radius;
  for (const MarkerMeaning& entry : chart.markers) {
    drawn += marker(entry.marker, x, 93, "#444444");
    drawn += text(x + 14, 98, {.size = 14}, entry.meaning);
    x += 48 + 7.4 * static_cast<double>(entry.meaning.size());
  }
  return drawn;
}

}  // namespace

std::vector<ScatterPoint> front_of(std::vector<ScatterPoint> points) {
  std::ranges::sort(points, [](const ScatterPoint& a, const ScatterPoint& b) {
    return std::pair(a.x, a.y) < std::pair(b.x, b.y);
  });
  std::vector<ScatterPoint> front;
  for (ScatterPoint& point : points) {
    if (front.empty() || point.y < front.back().y) front.push_back(std::move(point));
  }
  return front;
}

std::string to_svg(const ScatterChart& chart) {
  const std::pair<double, double> x_range = x_range_of(chart);
  std::string drawn = legend(chart);
  double y = header_height;
  for (const ScatterPanel& panel : chart.panels) {
    drawn += panel_svg(panel, x_range, y);
    y += panel_height;
  }
  drawn += text(width - margin, y + 16, {.size = 13, .color = quiet, .anchor = Anchor::end},
                chart.x_axis);
  const double height = y + footer_height;
  return svg::page(height, chart.frame, drawn);
}

}  // namespace bench
