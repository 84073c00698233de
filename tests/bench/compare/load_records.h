// SPDX-License-Identifier: MIT
// What was measured of loaders, as JSON, as a table and as a chart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/bench/compare/bar_chart.h"
#include "tests/bench/compare/check_numbers.h"
#include "tests/bench/compare/statistics.h"

namespace bench {

/// One loader on one file.
struct LoadRecord {
  std::string file;
  uint64_t file_bytes = 0;
  std::string loader;
  int threads = 1;
  int rounds = 0;
  Spread megabytes_a_second;  // 1e6 bytes of the file's, from its path to what can be shown
  // Of the speed, medians over the rounds; 0 where there is nothing to compare with.
  double ratio_to_tinyobjloader = 0;
  double ratio_to_one_thread = 0;
  size_t peak_bytes = 0;  // beyond mapped files, in a process of its own
  size_t mesh_bytes = 0;  // Boxwood's mesh of the same file: the same measure for all loaders
  uint64_t triangles = 0;
  NumberCheck numbers;

  bool is_ours() const { return loader == "boxwood"; }
  double peak_to_mesh() const {
    return static_cast<double>(peak_bytes) / static_cast<double>(mesh_bytes);
  }
};

void to_json(nlohmann::json& json, const LoadRecord& record);

std::string table_line(const LoadRecord& record);

/// Speed relative to tinyobjloader's on one thread, or in MB/s where it is missing, and memory.
BarChart load_chart(std::span<const LoadRecord> records, const std::string& machine);

}  // namespace bench
