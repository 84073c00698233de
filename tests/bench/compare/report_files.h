// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/bench/compare/svg.h"

namespace bench {

/// Writes PATH.json, an array of the records, with its folder. Throws std::runtime_error.
template <class Records>
void write_json(const std::filesystem::path& path, const Records& records) {
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  const std::string file_name = path.string() + ".json";
  if (!(std::ofstream(file_name) << nlohmann::json(records).dump(1) << '\n')) {
    throw std::runtime_error("cannot write " + file_name);
  }
  fmt::print("{}\n", file_name);
}

/// PATH.json and the chart, PATH.svg and PATH.png; prints what it wrote.
template <class Records, class Chart>
void write_report(const std::filesystem::path& path, const Records& records, const Chart& chart) {
  write_json(path, records);
  for (const auto& written : svg::write_files(to_svg(chart), path)) {
    fmt::print("{}\n", written.string());
  }
}

}  // namespace bench
