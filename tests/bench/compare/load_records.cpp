// SPDX-License-Identifier: MIT
#include "tests/bench/compare/load_records.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

namespace bench {
namespace {

std::string series_name(const LoadRecord& record) {
  return fmt::format("{}, {} thread{}", record.loader, record.threads,
                     record.threads == 1 ? "" : "s");
}

struct Measure {
  std::function<double(const LoadRecord&)> height;
  std::function<std::string(const LoadRecord&)> label;
};

BarPanel make_panel(std::span<const LoadRecord> records, BarChart& chart, const Measure& measure) {
  BarPanel panel;
  for (const LoadRecord& record : records) {
    const std::string name = series_name(record);
    auto series = std::ranges::find(chart.series, name, &BarSeries::name);
    if (series == chart.series.end()) {
      using enum BarSeries::Family;
      series = chart.series.insert(series, {name, record.is_ours() ? ours : others});
    }
    auto group = std::ranges::find(panel.groups, record.file, &BarGroup::label);
    if (group == panel.groups.end()) group = panel.groups.insert(group, {record.file, "", {}});
    group->bars.push_back({static_cast<size_t>(series - chart.series.begin()),
                           measure.height(record), measure.label(record)});
  }
  return panel;
}

}  // namespace

void to_json(nlohmann::json& json, const LoadRecord& record) {
  const Spread& speed = record.megabytes_a_second;
  json = {
      {"file", record.file},
      {"file_bytes", record.file_bytes},
      {"loader", record.loader},
      {"threads", record.threads},
      {"rounds", record.rounds},
      {"megabytes_a_second", {{"min", speed.min}, {"median", speed.median}, {"max", speed.max}}},
      {"ratio_to_tinyobjloader", record.ratio_to_tinyobjloader},
      {"ratio_to_one_thread", record.ratio_to_one_thread},
      {"peak_bytes", record.peak_bytes},
      {"mesh_bytes", record.mesh_bytes},
      {"peak_to_mesh", record.peak_to_mesh()},
      {"triangles", record.triangles},
      {"numbers_checked", record.numbers.checked},
      {"numbers_wrong_a_million", record.numbers.wrong_per_million()}};
}

std::string table_line(const LoadRecord& record) {
  const Spread& speed = record.megabytes_a_second;
  std::string line = fmt::format(
      "{:<6} {:<13} {} thread{}  {:>6.0f} MB/s ({:.0f} - {:.0f}, {} rounds)  peak {:>6.1f} MB, "
      "{:>4.2f} x the mesh  {:>6.0f} numbers wrong per million",
      record.file, record.loader, record.threads, record.threads == 1 ? " " : "s", speed.median,
      speed.min, speed.max, record.rounds, 1e-6 * static_cast<double>(record.peak_bytes),
      record.peak_to_mesh(), record.numbers.wrong_per_million());
  if (record.ratio_to_tinyobjloader > 0) {
    line += fmt::format("  x{:.2f} tinyobjloader", record.ratio_to_tinyobjloader);
  }
  if (record.ratio_to_one_thread > 0) {
    line += fmt::format("  x{:.2f} one thread", record.ratio_to_one_thread);
  }
  return line;
}

BarChart load_chart(std::span<const LoadRecord> records, const std::string& machine) {
  const bool has_ratios = std::ranges::all_of(
      records, [](const LoadRecord& record) { return record.ratio_to_tinyobjloader > 0; });
  BarChart chart;
  chart.frame.title = "Loading OBJ files";
  chart.frame.subtitle = "From a file to triangles, in memory beyond the file's own pages.";
  chart.frame.footer = machine;
  chart.panels.push_back(make_panel(
      records, chart,
      {[&](const LoadRecord& record) {
         return has_ratios ? record.ratio_to_tinyobjloader : record.megabytes_a_second.median;
       },
       [](const LoadRecord& record) {
         return fmt::format("{:.0f}", record.megabytes_a_second.median);
       }}));
  chart.panels.back().title = "Speed, higher is better; over each bar: MB/s";
  chart.panels.back().axis = has_ratios ? "relative to tinyobjloader's" : "MB/s";
  chart.panels.push_back(make_panel(
      records, chart,
      {[](const LoadRecord& record) { return record.peak_to_mesh(); },
       [](const LoadRecord& record) { return fmt::format("{:.1f}", record.peak_to_mesh()); }}));
  chart.panels.back().title = "Peak memory, lower is better";
  chart.panels.back().axis = "relative to Boxwood's mesh";
  return chart;
}

}  // namespace bench
