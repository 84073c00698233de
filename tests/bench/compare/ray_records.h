// SPDX-License-Identifier: MIT
// What was measured of rays, as JSON, as a table and as a chart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/bench/compare/bar_chart.h"
#include "tests/bench/compare/statistics.h"

namespace bench {

/// One tracer on one set of rays.
struct RayRecord {
  std::string scene;
  std::string rays;  // P, S, D or I
  int threads = 1;
  std::string tracer;
  Spread mrays_per_second;
  /// Answers unlike those of Boxwood's single rays, over all rays; of Boxwood's own hits also those
  /// unlike brute force's, bit for bit, over the first `oracle_rays` of a sample.
  uint64_t disagreements = 0;
  size_t ray_count = 0;
  size_t oracle_rays = 0;
  /// Of the speed to each Embree tracer's, median over the rounds.
  std::map<std::string, double> ratios;
};

void to_json(nlohmann::json& json, const RayRecord& record);

/// A line for each tracer, its ratios beside; of one scene and one thread count or of many.
std::string ray_table(std::span<const RayRecord> records);

/// For each ray kind, thread count, tracer of ours and tracer of Embree's: the geometric mean of
/// the ratios over all scenes, and the least of them.
std::string ratio_table(std::span<const RayRecord> records);

/// A panel for each ray kind, of the records on one thread; heights are speeds relative to Embree's
/// default, or Mray/s where there is no Embree.
BarChart ray_chart(std::span<const RayRecord> records, const std::string& machine);

}  // namespace bench
