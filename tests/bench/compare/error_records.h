// SPDX-License-Identifier: MIT
// Errors over time, as numbers, JSON, tables and a chart.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/bench/compare/error_measures.h"
#include "tests/bench/compare/line_chart.h"

namespace bench {

/// A mean over seeds, and where it lies in 19 of 20 cases [Student 1908].
struct Interval {
  double mean = 0, low = 0, high = 0;
};
/// Of at least one value; the mean alone where there is but one.
Interval interval_of(std::span<const double> values);

/// One picture, measured.
struct MeasuredSnapshot {
  int rung = 0;
  double seconds = 0;
  double samples = 0;
  ErrorMeasures errors;
};

/// The same rung of all seeds; means of them.
struct ErrorRung {
  double seconds = 0;
  double samples = 0;
  Interval relmse;
  double rmse = 0, mae = 0, flip = 0;
};

/// When an error is reached, on the line between two rungs, or on the fitted one beyond the last.
struct TimeTo {
  double relmse = 0;
  double seconds = 0;
  bool is_extrapolated = false;
};

struct ErrorCurve {
  std::string scene;
  std::string tracer;
  int seeds = 0;
  std::vector<ErrorRung> rungs;
  double rmse_slope = 0;         // of log RMSE over log seconds: -1/2 of independent samples
  double systematic_relmse = 0;  // that two seeds share, taken away from relmse; 0: not looked for
  std::vector<TimeTo> times;     // to relMSE 1e-2, 1e-3 and 1e-4
};

/// Of rungs that every seed has. `systematic_relmse` is taken away from each relMSE.
ErrorCurve make_curve(std::string scene, std::string tracer,
                      std::span<const std::vector<MeasuredSnapshot>> seeds,
                      double systematic_relmse = 0);

/// Nothing for less than two rungs.
std::optional<TimeTo> time_to(std::span<const ErrorRung> rungs, double relmse);

void to_json(nlohmann::json& json, const ErrorCurve& curve);

/// A line a rung.
std::string rung_table(const ErrorCurve& curve);
/// A line a curve: seconds to each error, and how many times as long as the first curve.
std::string time_table(std::span<const ErrorCurve> curves);

/// A panel a scene, a line a tracer.
LineChart error_chart(std::span<const ErrorCurve> curves, const std::string& machine);

}  // namespace bench
