// SPDX-License-Identifier: MIT
#include "tests/bench/compare/ray_records.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "tests/bench/compare/ray_sets.h"
#include "tests/bench/compare/tracers.h"

namespace bench {
namespace {

constexpr const char* embree_default = "embree";

bool is_ours(const std::string& tracer) {
  return tracer.starts_with("boxwood");
}

std::string three_digits(double value) {
  return fmt::format("{:.{}f}", value, value < 1 ? 3 : value < 10 ? 2 : 1);
}

double ratio_to(const RayRecord& record, const std::string& tracer) {
  const auto found = record.ratios.find(tracer);
  return found == record.ratios.end() ? 0 : found->second;
}

std::vector<BarSeries> series_of(std::span<const RayRecord> records) {
  using enum BarSeries::Family;
  std::vector<BarSeries> series;
  for (const RayRecord& record : records) {
    if (std::ranges::find(series, record.tracer, &BarSeries::name) != series.end()) continue;
    series.push_back({record.tracer, is_ours(record.tracer) ? ours : others});
  }
  return series;
}

BarGroup chart_group(std::span<const RayRecord> records, const std::vector<BarSeries>& all_series,
                     const std::string& scene, std::string_view kind) {
  BarGroup group{scene, "", {}};
  for (const RayRecord& record : records) {
    if (record.threads != 1 || record.scene != scene || record.rays != kind) continue;
    const double ratio = ratio_to(record, embree_default);
    const double speed = record.mrays_per_second.median;
    const auto series = std::ranges::find(all_series, record.tracer, &BarSeries::name);
    group.bars.push_back({static_cast<size_t>(series - all_series.begin()),
                          ratio > 0 ? ratio : speed, three_digits(speed)});
    if (group.note.empty() && ratio > 0) group.note = fmt::format("× {:.2f}", ratio);
  }
  return group;
}

}  // namespace

void to_json(nlohmann::json& json, const RayRecord& record) {
  const Spread& speed = record.mrays_per_second;
  json = {{"scene", record.scene},
          {"rays", record.rays},
          {"threads", record.threads},
          {"tracer", record.tracer},
          {"mrays_per_second", {{"min", speed.min}, {"median", speed.median}, {"max", speed.max}}},
          {"disagreements", record.disagreements},
          {"ray_count", record.ray_count},
          {"oracle_rays", record.oracle_rays},
          {"ratios", record.ratios}};
}

std::string ray_table(std::span<const RayRecord> records) {
  std::string table;
  for (const RayRecord& record : records) {
    const Spread& speed = record.mrays_per_second;
    table +=
        fmt::format("{:<8} {}  {} thread{}  {:<22} {:>7} ({} - {})", record.scene, record.rays,
                    record.threads, record.threads == 1 ? " " : "s", record.tracer,
                    three_digits(speed.median), three_digits(speed.min), three_digits(speed.max));
    if (is_ours(record.tracer)) {
      for (const auto& [tracer, ratio] : record.ratios) {
        table += fmt::format("  x{:.2f} {}", ratio, tracer);
      }
    }
    if (record.disagreements > 0) table += fmt::format("  {} disagree", record.disagreements);
    table += '\n';
  }
  return table;
}

std::string ratio_table(std::span<const RayRecord> records) {
  std::map<std::tuple<std::string, int, std::string, std::string>, std::vector<double>> ratios;
  for (const RayRecord& record : records) {
    if (!is_ours(record.tracer)) continue;
    for (const auto& [tracer, ratio] : record.ratios) {
      ratios[{record.rays, record.threads, record.tracer, tracer}].push_back(ratio);
    }
  }
  std::string table;
  for (const RayKind& kind : ray_kinds) {
    for (const auto& [key, values] : ratios) {
      const auto& [rays, threads, ours, other] = key;
      if (rays != kind.name) continue;
      table += fmt::format("{} {:<16} {} thread{}  {:<22} / {:<14} {:.2f}  least {:.2f}\n", rays,
                           kind.label, threads, threads == 1 ? " " : "s", ours, other,
                           geometric_mean(values), *std::ranges::min_element(values));
    }
  }
  return table;
}

BarChart ray_chart(std::span<const RayRecord> records, const std::string& machine) {
  const bool has_ratios =
      std::ranges::any_of(records, [](const RayRecord& record) { return !record.ratios.empty(); });
  BarChart chart;
  chart.frame.title = "Rays traced a second, one thread";
  chart.frame.subtitle = has_ratios
                             ? "Over each bar: million rays a second. Higher is better; below each "
                               "scene, Boxwood's single rays against Embree's."
                             : "Million rays a second; higher is better.";
  chart.frame.footer = machine;
  chart.series = series_of(records);
  chart.reference = has_ratios ? 1 : 0;
  std::vector<std::string> scenes;
  for (const RayRecord& record : records) {
    if (std::ranges::find(scenes, record.scene) == scenes.end()) scenes.push_back(record.scene);
  }
  for (const RayKind& kind : ray_kinds) {
    BarPanel panel{fmt::format("{}: {}", kind.name, kind.label),
                   has_ratios ? "speed relative to Embree's default" : "Mray/s",
                   {}};
    for (const std::string& scene : scenes) {
      panel.groups.push_back(chart_group(records, chart.series, scene, kind.name));
    }
    chart.panels.push_back(std::move(panel));
  }
  return chart;
}

}  // namespace bench
