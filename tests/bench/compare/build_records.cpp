// SPDX-License-Identifier: MIT
#include "tests/bench/compare/build_records.h"

#include <algorithm>
#include <functional>
#include <vector>

#include <fmt/format.h>

namespace bench {
namespace {

nlohmann::json json_of(const Spread& spread) {
  return {{"min", spread.min}, {"median", spread.median}, {"max", spread.max}};
}

std::string short_time(double ms) {
  return ms < 10 ? fmt::format("{:.1f}", ms) : fmt::format("{:.0f}", ms);
}

struct Measure {
  std::function<double(const BuildRecord&)> height;
  std::function<std::string(const BuildRecord&)> label;
};

BarPanel make_panel(std::span<const BuildRecord> records, int threads, BarChart& chart,
                    const Measure& measure) {
  BarPanel panel;
  for (const BuildRecord& record : records) {
    if (record.threads != threads) continue;
    auto series = std::ranges::find(chart.series, record.builder, &BarSeries::name);
    if (series == chart.series.end()) {
      using enum BarSeries::Family;
      series = chart.series.insert(series, {record.builder, record.is_ours() ? ours : others});
    }
    auto group = std::ranges::find(panel.groups, record.scene, &BarGroup::label);
    if (group == panel.groups.end()) group = panel.groups.insert(group, {record.scene, "", {}});
    group->bars.push_back({static_cast<size_t>(series - chart.series.begin()),
                           measure.height(record), measure.label(record)});
  }
  return panel;
}

}  // namespace

void to_json(nlohmann::json& json, const BuildRecord& record) {
  json = {{"scene", record.scene},           {"threads", record.threads},
          {"builder", record.builder},       {"ms", record.ms.median},
          {"ms_spread", json_of(record.ms)}, {"sah", record.sah},
          {"bytes", record.bytes},           {"bytes_a_triangle", record.bytes_a_triangle()},
          {"triangles", record.triangles},   {"ratio", record.ratio}};
  if (!record.is_ours()) return;
  json["tree_ms"] = json_of(record.tree_ms);
  json["layout_ms"] = json_of(record.layout_ms);
  json["tree_bytes"] = record.tree_bytes;
}

std::string build_table(std::span<const BuildRecord> records) {
  std::string table;
  for (const BuildRecord& record : records) {
    table +=
        fmt::format("{:<8} {} thread{}  {:<14} {:>8.1f} ms ({:.1f} - {:.1f})  {:>5.1f} B held",
                    record.scene, record.threads, record.threads == 1 ? " " : "s", record.builder,
                    record.ms.median, record.ms.min, record.ms.max, record.bytes_a_triangle());
    if (record.ratio > 0) table += fmt::format("  x{:.2f} MEDIUM", record.ratio);
    if (record.is_ours()) {
      table += fmt::format("  SAH {:.2f}  tree {:.1f} ms + layout {:.1f} ms, {:.1f} B let go",
                           record.sah, record.tree_ms.median, record.layout_ms.median,
                           static_cast<double>(record.tree_bytes) / record.triangles);
    }
    table += '\n';
  }
  return table;
}

BarChart build_chart(std::span<const BuildRecord> records, int threads,
                     const std::string& machine) {
  const bool has_ratios =
      std::ranges::any_of(records, [](const BuildRecord& record) { return record.ratio > 0; });
  BarChart chart;
  chart.frame.title = fmt::format("Building a tree, {} thread{}", threads, threads == 1 ? "" : "s");
  chart.frame.subtitle = "From triangles to what rays are traced through. Lower is better.";
  chart.frame.footer = machine;
  chart.panels.push_back(make_panel(
      records, threads, chart,
      {[&](const BuildRecord& record) { return has_ratios ? record.ratio : record.ms.median; },
       [](const BuildRecord& record) { return short_time(record.ms.median); }}));
  chart.panels.back().title = "Time; over each bar: milliseconds";
  chart.panels.back().axis = has_ratios ? "time relative to Embree MEDIUM's" : "ms";
  chart.panels.push_back(
      make_panel(records, threads, chart,
                 {[](const BuildRecord& record) { return record.bytes_a_triangle(); },
                  [](const BuildRecord& record) {
                    return fmt::format("{:.0f}", record.bytes_a_triangle());
                  }}));
  chart.panels.back().title = "Memory held beside the mesh";
  chart.panels.back().axis = "bytes a triangle";
  return chart;
}

}  // namespace bench
