// SPDX-License-Identifier: MIT
#include "tests/bench/compare/error_records.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "tests/support/log_line.h"

namespace bench {
namespace {

constexpr double told_errors[] = {1e-2, 1e-3, 1e-4};

/// 97.5 % quantiles of Student's t for 1, 2, 3 ... degrees of freedom.
double student_quantile(size_t degrees) {
  constexpr double table[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                              2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131};
  return degrees <= std::size(table) ? table[degrees - 1]
                                     : 1.960 + 2.4 / static_cast<double>(degrees);
}

/// A line through what is told of each rung at its time.
template <class Y>
tests::LogLine fit_over_seconds(std::span<const ErrorRung> rungs, const Y& y_of) {
  std::vector<tests::LogPoint> points;
  for (const ErrorRung& rung : rungs) points.push_back({rung.seconds, y_of(rung)});
  return tests::fit_log_line(points);
}

double relmse_of(const ErrorRung& rung) {
  return rung.relmse.mean;
}
double rmse_of(const ErrorRung& rung) {
  return rung.rmse;
}

template <class F>
std::vector<double> collect(std::span<const MeasuredSnapshot> snapshots, const F& f) {
  std::vector<double> values;
  for (const MeasuredSnapshot& snapshot : snapshots) values.push_back(f(snapshot));
  return values;
}

ErrorRung make_rung(std::span<const MeasuredSnapshot> snapshots, double systematic_relmse) {
  const auto mean = [&](const auto& f) { return interval_of(collect(snapshots, f)).mean; };
  ErrorRung rung;
  rung.seconds = mean([](const auto& s) { return s.seconds; });
  rung.samples = mean([](const auto& s) { return s.samples; });
  rung.relmse = interval_of(
      collect(snapshots, [&](const auto& s) { return s.errors.relmse - systematic_relmse; }));
  rung.rmse = mean([](const auto& s) { return s.errors.rmse; });
  rung.mae = mean([](const auto& s) { return s.errors.mae; });
  rung.flip = mean([](const auto& s) { return s.errors.flip; });
  return rung;
}

std::string in_words(const TimeTo& time) {
  const int decimals = time.seconds < 1 ? 3 : time.seconds < 10 ? 2 : time.seconds < 100 ? 1 : 0;
  return fmt::format("{}{:.{}f}", time.is_extrapolated ? "~" : "", time.seconds, decimals);
}

// After Okabe and Ito: told apart with every kind of color vision.
constexpr std::pair<std::string_view, const char*> colors[] = {
    {"Boxwood", "#0072B2"},        {"Cycles", "#D55E00"},  {"adaptive", "#009E73"},
    {"independent", "#AA4499"},    {"no-skip", "#888888"}, {"spatial median", "#B8860B"},
    {"spatial splits", "#56B4E9"},
};

std::string color_of(const std::string& tracer) {
  for (const auto& [name, color] : colors) {
    if (tracer.starts_with(name)) return color;
  }
  return "#222222";
}

const TimeTo* time_of(const ErrorCurve& curve, double relmse) {
  const auto found = std::ranges::find(curve.times, relmse, &TimeTo::relmse);
  return found == curve.times.end() ? nullptr : &*found;
}

std::string note_of(std::span<const ErrorCurve> curves) {
  constexpr double compared_error = 1e-3;
  const TimeTo* ours = time_of(curves.front(), compared_error);
  if (ours == nullptr) return "";
  std::string note = fmt::format("1e-3 after {} s", in_words(*ours));
  for (const ErrorCurve& curve : curves) {
    const TimeTo* theirs = time_of(curve, compared_error);
    if (!curve.tracer.starts_with("Cycles") || theirs == nullptr) continue;
    note += fmt::format("; Cycles {} s, {:.1f} times as long", in_words(*theirs),
                        theirs->seconds / ours->seconds);
  }
  return note;
}

/// Neighbours of one scene.
std::vector<std::span<const ErrorCurve>> by_scene(std::span<const ErrorCurve> curves) {
  std::vector<std::span<const ErrorCurve>> scenes;
  for (size_t first = 0, end; first < curves.size(); first = end) {
    for (end = first; end < curves.size() && curves[end].scene == curves[first].scene;) ++end;
    scenes.push_back(curves.subspan(first, end - first));
  }
  return scenes;
}

}  // namespace

Interval interval_of(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  const auto count = static_cast<double>(values.size());
  const double mean = sum / count;
  if (values.size() < 2) return {mean, mean, mean};
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const double half =
      student_quantile(values.size() - 1) * std::sqrt(squares / (count - 1) / count);
  return {mean, mean - half, mean + half};
}

std::optional<TimeTo> time_to(std::span<const ErrorRung> rungs, double relmse) {
  if (rungs.size() < 2) return std::nullopt;
  for (size_t i = 0; i + 1 < rungs.size(); ++i) {
    const bool is_between = relmse_of(rungs[i]) > relmse && relmse_of(rungs[i + 1]) <= relmse;
    if (!is_between || !(relmse_of(rungs[i + 1]) > 0)) continue;
    return TimeTo{relmse, fit_over_seconds(rungs.subspan(i, 2), relmse_of).x_of(relmse), false};
  }
  // The later half: the first samples of a sequence tell little of how it goes on.
  const bool is_before = relmse_of(rungs.front()) <= relmse;
  const std::span<const ErrorRung> part =
      is_before ? rungs.first(2) : rungs.subspan(std::min(rungs.size() / 2, rungs.size() - 2));
  const tests::LogLine line = fit_over_seconds(part, relmse_of);
  if (!(line.slope < 0)) return std::nullopt;
  return TimeTo{relmse, line.x_of(relmse), true};
}

ErrorCurve make_curve(std::string scene, std::string tracer,
                      std::span<const std::vector<MeasuredSnapshot>> seeds,
                      double systematic_relmse) {
  ErrorCurve curve;
  curve.scene = std::move(scene);
  curve.tracer = std::move(tracer);
  curve.seeds = static_cast<int>(seeds.size());
  curve.systematic_relmse = systematic_relmse;
  std::map<int, std::vector<MeasuredSnapshot>> by_rung;
  for (const auto& seed : seeds) {
    for (const MeasuredSnapshot& snapshot : seed) by_rung[snapshot.rung].push_back(snapshot);
  }
  for (const auto& [rung, snapshots] : by_rung) {
    if (snapshots.size() == seeds.size()) {
      curve.rungs.push_back(make_rung(snapshots, systematic_relmse));
    }
  }
  curve.rmse_slope = fit_over_seconds(curve.rungs, rmse_of).slope;
  for (const double error : told_errors) {
    if (const auto time = time_to(curve.rungs, error)) curve.times.push_back(*time);
  }
  return curve;
}

void to_json(nlohmann::json& json, const ErrorCurve& curve) {
  json = {{"scene", curve.scene},
          {"tracer", curve.tracer},
          {"seeds", curve.seeds},
          {"rmse_slope", curve.rmse_slope},
          {"systematic_relmse", curve.systematic_relmse},
          {"rungs", nlohmann::json::array()},
          {"seconds_to", nlohmann::json::array()}};
  for (const ErrorRung& rung : curve.rungs) {
    json["rungs"].push_back(
        {{"seconds", rung.seconds},
         {"samples", rung.samples},
         {"relmse",
          {{"mean", rung.relmse.mean}, {"low", rung.relmse.low}, {"high", rung.relmse.high}}},
         {"rmse", rung.rmse},
         {"mae", rung.mae},
         {"flip", rung.flip}});
  }
  for (const TimeTo& time : curve.times) {
    json["seconds_to"].push_back({{"relmse", time.relmse},
                                  {"seconds", time.seconds},
                                  {"is_extrapolated", time.is_extrapolated}});
  }
}

std::string rung_table(const ErrorCurve& curve) {
  std::string table =
      fmt::format("{:<16} {:>8} {:>9} {:>9} {:>21} {:>9} {:>9} {:>7}\n", curve.tracer, "seconds",
                  "samples", "relMSE", "in 19 of 20 cases", "RMSE", "MAE", "FLIP");
  for (const ErrorRung& rung : curve.rungs) {
    table += fmt::format(
        "{:<16} {:>8.3f} {:>9.1f} {:>9.2e} {:>9.2e} - {:>9.2e} {:>9.2e} {:>9.2e} {:>7.4f}\n", "",
        rung.seconds, rung.samples, rung.relmse.mean, rung.relmse.low, rung.relmse.high, rung.rmse,
        rung.mae, rung.flip);
  }
  return table;
}

std::string time_table(std::span<const ErrorCurve> curves) {
  std::string table = fmt::format("{:<13} {:<16} {:>14} {:>16} {:>16} {:>7}\n", "scene",
                                  "seconds to", "relMSE 1e-2", "1e-3", "1e-4", "slope");
  for (const std::span<const ErrorCurve>& scene : by_scene(curves)) {
    for (const ErrorCurve& curve : scene) {
      table += fmt::format("{:<13} {:<16}", curve.scene, curve.tracer);
      for (const double error : told_errors) {
        const TimeTo* time = time_of(curve, error);
        const TimeTo* ours = time_of(scene.front(), error);
        std::string cell = time != nullptr ? in_words(*time) : "-";
        if (time != nullptr && ours != nullptr && &curve != &scene.front()) {
          cell += fmt::format(" ({:.2f}x)", time->seconds / ours->seconds);
        }
        table += fmt::format(" {:>16}", cell);
      }
      table += fmt::format(" {:>6.2f}\n", curve.rmse_slope);
    }
  }
  return table;
}

LineChart error_chart(std::span<const ErrorCurve> curves, const std::string& machine) {
  LineChart chart;
  chart.frame.title = "Path tracing: error against time";
  chart.frame.subtitle =
      "relMSE, the mean of (x - r)² / (r² + 0.01), against a reference that took far longer. "
      "Lower left is better.";
  chart.frame.footer = machine;
  chart.x_axis = "seconds of rendering";
  for (const std::span<const ErrorCurve>& scene : by_scene(curves)) {
    LinePanel panel{scene.front().scene, note_of(scene), {}};
    for (const ErrorCurve& curve : scene) {
      LineSeries series{curve.tracer, color_of(curve.tracer), {}};
      for (const ErrorRung& rung : curve.rungs) {
        if (!(rung.relmse.mean > 0)) continue;
        series.points.push_back({rung.seconds, rung.relmse.mean,
                                 std::max(rung.relmse.low, rung.relmse.mean / 10),
                                 rung.relmse.high});
      }
      panel.series.push_back(std::move(series));
    }
    chart.panels.push_back(std::move(panel));
  }
  return chart;
}

}  // namespace bench
