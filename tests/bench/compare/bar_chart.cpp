// SPDX-License-Identifier: MIT
#include "tests/bench/compare/bar_chart.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bench {
namespace {

// After Okabe and Ito: told apart with every kind of color vision.
constexpr const char* our_colors[] = {"#0072B2", "#56B4E9", "#009E73",
                                      "#CC79A7", "#004A73", "#88CCEE"};
constexpr const char* other_colors[] = {"#E69F00", "#D55E00", "#999999", "#F0E442"};

using Colors = std::vector<std::string>;

Colors colors_of(const std::vector<BarSeries>& series) {
  size_t our_count = 0;
  size_t other_count = 0;
  Colors chosen;
  for (const BarSeries& one : series) {
    chosen.emplace_back(one.family == BarSeries::Family::ours
                            ? our_colors[our_count++ % std::size(our_colors)]
                            : other_colors[other_count++ % std::size(other_colors)]);
  }
  return chosen;
}

constexpr double width = svg::page_width;
constexpr double margin = svg::page_margin;
constexpr double axis_width = 52;
constexpr double header_height = 112;
constexpr double panel_height = 246;
constexpr double panel_head = 50;  // title, and room for labels over the tallest bar
constexpr double panel_foot = 50;  // labels of the groups
constexpr double footer_height = 34;
constexpr double plot_height = panel_height - panel_head - panel_foot;

using svg::Anchor;
using svg::rectangle;
using svg::text;

std::string horizontal_line(double y, const char* attributes) {
  return svg::line(margin + axis_width, y, width - margin, y, attributes);
}

// 1, 2 or 5 times a power of ten, so that four to eight steps reach `top`.
double tick_step(double top) {
  const double power = std::pow(10, std::floor(std::log10(top / 4)));
  const double steps = top / 4 / power;
  return power * (steps >= 5 ? 5 : steps >= 2 ? 2 : 1);
}

double tallest(const BarPanel& panel, double reference) {
  double top = reference;
  for (const BarGroup& group : panel.groups) {
    for (const Bar& bar : group.bars) top = std::max(top, bar.height);
  }
  return top > 0 ? top : 1;
}

std::string legend(const BarChart& chart, const Colors& colors, double y) {
  std::string svg;
  double x = margin;
  for (size_t i = 0; i < chart.series.size(); ++i) {
    svg += rectangle(x, y - 12, 14, 14, colors[i]);
    svg += text(x + 20, y, {.size = 14}, chart.series[i].name);
    x += 46 + 8.6 * static_cast<double>(chart.series[i].name.size());
  }
  return svg;
}

std::string axis(const BarPanel& panel, double base, double top) {
  std::string svg;
  const double step = tick_step(top);
  for (int tick = 0; tick * step <= top; ++tick) {
    const double y = base - plot_height * tick * step / top;
    svg += horizontal_line(y, tick == 0 ? "stroke=\"#666666\"" : "stroke=\"#E4E4E4\"");
    svg += text(margin + axis_width - 8, y + 4,
                {.size = 12, .color = "#666666", .anchor = Anchor::end},
                fmt::format("{:g}", tick * step));
  }
  return svg + text(width - margin, base - plot_height - panel_head + 22,
                    {.size = 12, .color = "#666666", .anchor = Anchor::end}, panel.axis);
}

/// Where a group of bars goes: [left, left + width), upward from base; `top` is the full height.
struct GroupPlace {
  double left, width, base, top;
};

std::string bars_of(const BarGroup& group, const Colors& colors, const GroupPlace& place) {
  const double bar_width = std::min(
      0.86 * place.width / static_cast<double>(std::max<size_t>(group.bars.size(), 1)), 40.0);
  const double middle = place.left + place.width / 2;
  double x = middle - bar_width * static_cast<double>(group.bars.size()) / 2;
  std::string svg;
  for (const Bar& bar : group.bars) {
    const double height = plot_height * bar.height / place.top;
    svg += rectangle(x + 1, place.base - height, bar_width - 2, height, colors[bar.series]);
    svg += text(x + bar_width / 2, place.base - height - 4,
                {.size = std::min(12.0, 0.32 * bar_width), .anchor = Anchor::middle}, bar.label);
    x += bar_width;
  }
  svg += text(middle, place.base + 18, {.size = 14, .anchor = Anchor::middle}, group.label);
  return svg +
         text(middle, place.base + 35,
              {.size = 13, .color = our_colors[0], .anchor = Anchor::middle, .weight = "bold"},
              group.note);
}

std::string panel_svg(const BarPanel& panel, const Colors& colors, double y, double reference) {
  const double base = y + panel_height - panel_foot;
  const double top = tallest(panel, reference);
  std::string svg = text(margin, y + 22, {.size = 17, .weight = "bold"}, panel.title);
  svg += axis(panel, base, top);
  if (reference > 0) {
    svg += horizontal_line(base - plot_height * reference / top,
                           "stroke=\"#222222\" stroke-dasharray=\"5 4\"");
  }
  const double group_width = (width - 2 * margin - axis_width) /
                             static_cast<double>(std::max<size_t>(panel.groups.size(), 1));
  double left = margin + axis_width;
  for (const BarGroup& group : panel.groups) {
    svg += bars_of(group, colors, {left, group_width, base, top});
    left += group_width;
  }
  return svg;
}

}  // namespace

std::string to_svg(const BarChart& chart) {
  const Colors colors = colors_of(chart.series);
  const double height =
      header_height + panel_height * static_cast<double>(chart.panels.size()) + footer_height;
  std::string svg = legend(chart, colors, 94);
  double y = header_height;
  for (const BarPanel& panel : chart.panels) {
    svg += panel_svg(panel, colors, y, chart.reference);
    y += panel_height;
  }
  return svg::page(height, chart.frame, svg);
}

}  // namespace bench
