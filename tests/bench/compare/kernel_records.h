// SPDX-License-Identifier: MIT
// What was measured of ray-triangle tests, as JSON, as tables and as a chart.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/bench/compare/scatter_chart.h"
#include "tests/bench/compare/statistics.h"

namespace bench {

/// One kernel on rays of one aiming.
struct KernelRecord {
  std::string kernel;
  std::string form;  // "scalar", "SIMD" or "whole call"
  std::string rays;  // name of an aiming
  Spread nanoseconds_a_test;
  uint64_t tests = 0;
  uint64_t hits = 0;  // in truth
  uint64_t wrong_verdicts = 0;
  uint64_t aimed_rays = 0;  // 0 where none can leak
  uint64_t leaks = 0;
  double t_error_p9999_ulp = 0;
  double t_error_max_ulp = 0;

  bool is_ours() const { return kernel.starts_with("Boxwood"); }
};

/// In ten thousandths of a per cent; 0 of 0 is 0.
double a_million(uint64_t part, uint64_t whole);

void to_json(nlohmann::json& json, const KernelRecord& record);

std::string kernel_table(std::span<const KernelRecord> records);

/// One kernel on all rays: counts are sums, errors the greatest of any aiming, the time is that on
/// the first aiming's, random rays.
std::vector<KernelRecord> summarised(std::span<const KernelRecord> records);

/// Time against leaks, wrong verdicts and errors of t; of summarised records.
ScatterChart kernel_chart(std::span<const KernelRecord> summary, const std::string& machine);

}  // namespace bench
