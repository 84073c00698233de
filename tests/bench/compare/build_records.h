// SPDX-License-Identifier: MIT
// What was measured of builders, as JSON, as a table and as a chart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/bench/compare/bar_chart.h"
#include "tests/bench/compare/statistics.h"

namespace bench {

/// One builder on one scene.
struct BuildRecord {
  std::string scene;
  int threads = 1;
  std::string builder;  // a name of Boxwood's table, or "embree" and its quality
  Spread ms;            // wall-clock, to a tree that rays can be traced through
  Spread tree_ms;       // of Boxwood: the binary tree alone
  Spread layout_ms;     // of Boxwood: its layout for the kernels
  double sah = 0;       // of the binary tree; 0 where it is not known
  // Beside the mesh, for good: of Boxwood what rays are traced through, of Embree what is left in
  // use once the scene is committed.
  size_t bytes = 0;
  size_t tree_bytes =
      0;  // of Boxwood: the binary tree, let go once laid out, improved and measured
  uint32_t triangles = 0;
  double ratio = 0;  // of the time to Embree MEDIUM's, median over the rounds; 0 without Embree

  bool is_ours() const { return !builder.starts_with("embree"); }
  double bytes_a_triangle() const {
    return static_cast<double>(bytes) / static_cast<double>(triangles);
  }
};

void to_json(nlohmann::json& json, const BuildRecord& record);

std::string build_table(std::span<const BuildRecord> records);

/// Times and bytes of the records on `threads` threads; times are relative to Embree MEDIUM's, or
/// in milliseconds where there is no Embree.
BarChart build_chart(std::span<const BuildRecord> records, int threads, const std::string& machine);

}  // namespace bench
