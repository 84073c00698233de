// SPDX-License-Identifier: MIT
#include "tests/bench/compare/exactness_records.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace bench {
namespace {

nlohmann::json json_of(const Spread& spread) {
  return {{"min", spread.min}, {"median", spread.median}, {"max", spread.max}};
}

}  // namespace

void to_json(nlohmann::json& json, const ExactnessRecord& record) {
  json = {{"scene", record.scene},
          {"rays", record.rays},
          {"way", record.way},
          {"exact_mrays_per_second", json_of(record.exact_mrays_per_second)},
          {"moeller_mrays_per_second", json_of(record.moeller_mrays_per_second)},
          {"cost", record.cost()},
          {"blocks_a_ray", record.blocks},
          {"exact_tests_a_ray", record.exact_tests},
          {"ray_count", record.ray_count},
          {"disagreements", record.disagreements}};
}

std::string exactness_table(std::span<const ExactnessRecord> records) {
  std::string table;
  for (const ExactnessRecord& record : records) {
    table += fmt::format(
        "{:<8} {}  {:<8} exact {:>6.2f}  Moeller-Trumbore {:>6.2f}  cost {:>5.1f} %  "
        "{:.2f} blocks, {:.2f} exact tests a ray; {} of {} rays answered otherwise\n",
        record.scene, record.rays, record.way, record.exact_mrays_per_second.median,
        record.moeller_mrays_per_second.median, 100 * record.cost(), record.blocks,
        record.exact_tests, record.disagreements, record.ray_count);
  }
  return table;
}

std::string exactness_summary(std::span<const ExactnessRecord> records) {
  std::string summary;
  std::vector<std::string> ways;
  for (const ExactnessRecord& record : records) {
    if (std::ranges::find(ways, record.way) == ways.end()) ways.push_back(record.way);
  }
  for (const std::string& way : ways) {
    std::vector<double> ratios;
    for (const ExactnessRecord& record : records) {
      if (record.way == way) ratios.push_back(record.speed_ratio);
    }
    summary += fmt::format("{:<8} exactness costs {:.1f} % of the speed, at most {:.1f} %\n", way,
                           100 * (1 - geometric_mean(ratios)),
                           100 * (1 - *std::ranges::min_element(ratios)));
  }
  return summary;
}

}  // namespace bench
