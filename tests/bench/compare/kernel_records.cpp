// SPDX-License-Identifier: MIT
#include "tests/bench/compare/kernel_records.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace bench {
namespace {

std::string three_digits(double value) {
  if (value == 0) return "0";
  if (value < 0.001 || value >= 100'000) return fmt::format("{:.1e}", value);
  return fmt::format("{:.{}f}", value, value < 1 ? 3 : value < 10 ? 2 : value < 100 ? 1 : 0);
}

// After Okabe and Ito: told apart with every kind of color vision.
constexpr std::pair<std::string_view, const char*> colors[] = {
    {"Boxwood", "#0072B2"},
    {"Möller-Trumbore", "#D55E00"},
    {"Woop 2013", "#AA4499"},
    {"Plücker", "#B8860B"},
    {"Embree", "#555555"},
    {"Embree ROBUST", "#555555"},
    {"Möller-Trumbore in double", "#882255"},
};

const char* color_of(const std::string& kernel) {
  const auto found = std::ranges::find(colors, std::string_view(kernel),
                                       &std::pair<std::string_view, const char*>::first);
  return found == std::end(colors) ? "#222222" : found->second;
}

Marker marker_of(const std::string& form) {
  return form == "SIMD" ? Marker::disc : form == "scalar" ? Marker::ring : Marker::diamond;
}

template <class Value>
ScatterPanel panel_of(std::span<const KernelRecord> summary, std::string title, std::string zero,
                      const Value& value) {
  ScatterPanel panel{std::move(title), std::move(zero), {}};
  for (const KernelRecord& record : summary) {
    panel.points.push_back({record.kernel, color_of(record.kernel), marker_of(record.form),
                            record.nanoseconds_a_test.median, value(record)});
  }
  return panel;
}

std::string none_of(uint64_t count, const char* what) {
  std::string digits = std::to_string(count);
  for (size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ',');
  return fmt::format("green: none of {} {}", digits, what);
}

}  // namespace

double a_million(uint64_t part, uint64_t whole) {
  return whole == 0 ? 0 : 1e6 * static_cast<double>(part) / static_cast<double>(whole);
}

void to_json(nlohmann::json& json, const KernelRecord& record) {
  const Spread& time = record.nanoseconds_a_test;
  json = {{"kernel", record.kernel},
          {"form", record.form},
          {"rays", record.rays},
          {"nanoseconds_a_test", {{"min", time.min}, {"median", time.median}, {"max", time.max}}},
          {"wrong_verdicts_per_million", a_million(record.wrong_verdicts, record.tests)},
          {"leaks_per_million", a_million(record.leaks, record.aimed_rays)},
          {"t_error_ulp", {{"p9999", record.t_error_p9999_ulp}, {"max", record.t_error_max_ulp}}},
          {"tests", record.tests},
          {"hits", record.hits},
          {"wrong_verdicts", record.wrong_verdicts},
          {"aimed_rays", record.aimed_rays},
          {"leaks", record.leaks}};
}

std::string kernel_table(std::span<const KernelRecord> records) {
  std::string table =
      fmt::format("{:<9} {:<27} {:<10} {:>6} {:>15} {:>10} {:>10} {:>10} {:>10}\n", "rays",
                  "kernel", "form", "ns", "min - max", "wrong/M", "leaks/M", "t p99.99", "t max");
  for (const KernelRecord& record : records) {
    const Spread& time = record.nanoseconds_a_test;
    table += fmt::format(
        "{:<9} {:<27} {:<10} {:>6} {:>15} {:>10} {:>10} {:>10} {:>10}\n", record.rays,
        record.kernel, record.form, three_digits(time.median),
        fmt::format("{} - {}", three_digits(time.min), three_digits(time.max)),
        three_digits(a_million(record.wrong_verdicts, record.tests)),
        record.aimed_rays == 0 ? "" : three_digits(a_million(record.leaks, record.aimed_rays)),
        three_digits(record.t_error_p9999_ulp), three_digits(record.t_error_max_ulp));
  }
  return table;
}

std::vector<KernelRecord> summarised(std::span<const KernelRecord> records) {
  std::vector<KernelRecord> summary;
  for (const KernelRecord& record : records) {
    const auto found = std::ranges::find_if(summary, [&](const KernelRecord& other) {
      return other.kernel == record.kernel && other.form == record.form;
    });
    if (found == summary.end()) {
      summary.push_back(record);
      summary.back().rays = "all";
      continue;
    }
    found->tests += record.tests;
    found->hits += record.hits;
    found->wrong_verdicts += record.wrong_verdicts;
    found->aimed_rays += record.aimed_rays;
    found->leaks += record.leaks;
    found->t_error_p9999_ulp = std::max(found->t_error_p9999_ulp, record.t_error_p9999_ulp);
    found->t_error_max_ulp = std::max(found->t_error_max_ulp, record.t_error_max_ulp);
  }
  return summary;
}

ScatterChart kernel_chart(std::span<const KernelRecord> summary, const std::string& machine) {
  ScatterChart chart;
  chart.frame.title = "Ray-triangle tests: time against error";
  chart.frame.subtitle =
      "The same rays for all, aimed at edges and vertices, grazing, far away, far from 0; judged "
      "by "
      "exact arithmetic. Lower left is better.";
  chart.frame.footer = machine;
  chart.x_axis = "nanoseconds a ray-triangle test, on random rays";
  chart.markers = {{Marker::disc, "SIMD, a block of triangles at a time"},
                   {Marker::ring, "scalar"},
                   {Marker::diamond, "a whole call for a ray, its time shared by the triangles"}};
  if (summary.empty()) return chart;
  chart.panels = {
      panel_of(
          summary, "Leaks a million rays aimed at the inside of a closed surface",
          none_of(summary.front().aimed_rays, "rays"),
          [](const KernelRecord& record) { return a_million(record.leaks, record.aimed_rays); }),
      panel_of(summary, "Wrong verdicts a million tests", none_of(summary.front().tests, "tests"),
               [](const KernelRecord& record) {
                 return a_million(record.wrong_verdicts, record.tests);
               }),
      panel_of(summary, "Largest error of a hit's distance, in ulps of a float", "",
               [](const KernelRecord& record) { return record.t_error_max_ulp; })};
  return chart;
}

}  // namespace bench
