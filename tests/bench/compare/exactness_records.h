// SPDX-License-Identifier: MIT
// What exact leaves cost the production traversal, as JSON and as a table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/bench/compare/statistics.h"

namespace bench {

/// One set of rays through the same tree and traversal, with both kinds of leaves.
struct ExactnessRecord {
  std::string scene;
  std::string rays;  // P, S, D, I, or F: a camera 10,000 times the model's size away
  std::string way;   // "single" or "streams"
  Spread exact_mrays_per_second;
  Spread moeller_mrays_per_second;
  double speed_ratio = 0;  // exact / Moeller-Trumbore, median over the rounds
  // Of the exact leaves, a ray in the mean: blocks filtered, and triangles that the filter left.
  double blocks = 0;
  double exact_tests = 0;
  size_t ray_count = 0;
  uint64_t disagreements = 0;  // rays that Moeller-Trumbore answers otherwise

  /// Part of the speed that exactness takes; negative where it gives.
  double cost() const { return 1 - speed_ratio; }
};

void to_json(nlohmann::json& json, const ExactnessRecord& record);

std::string exactness_table(std::span<const ExactnessRecord> records);

/// For each way: the geometric mean of the cost over all records, and the greatest.
std::string exactness_summary(std::span<const ExactnessRecord> records);

}  // namespace bench
