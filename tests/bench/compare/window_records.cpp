// SPDX-License-Identifier: MIT
#include "tests/bench/compare/window_records.h"

#include <algorithm>

#include <fmt/format.h>

#include "tests/bench/compare/statistics.h"

namespace bench {
namespace {

Spread spread_over(const std::vector<FrameRate>& rates, double FrameRate::*number) {
  std::vector<double> values;
  for (const FrameRate& rate : rates) values.push_back(rate.*number);
  return spread_of(values);
}

nlohmann::json json_of(const Spread& spread) {
  return {{"min", spread.min}, {"median", spread.median}, {"max", spread.max}};
}

}  // namespace

FrameRate frame_rate_of(std::span<const double> times, double end_seconds) {
  double before = 0, longest = 0;
  for (const double time : times) {
    longest = std::max(longest, time - before);
    before = time;
  }
  longest = std::max(longest, end_seconds - before);
  return {static_cast<double>(times.size()) / end_seconds, 1000 * longest};
}

void to_json(nlohmann::json& json, const LatencyRecord& record) {
  json = {{"scene", record.scene},
          {"measure", record.measure},
          {"events", record.ms.size()},
          {"unanswered", record.unanswered},
          {"ms", json_of(spread_of(record.ms))}};
  json["ms"]["p95"] = quantile(record.ms, 0.95);
  if (record.pictures_per_second > 0) json["pictures_per_second"] = record.pictures_per_second;
}

void to_json(nlohmann::json& json, const DragRecord& record) {
  json = {{"scene", record.scene},
          {"measure", record.measure},
          {"drags", record.rates.size()},
          {"frames_per_second", json_of(spread_over(record.rates, &FrameRate::frames_per_second))},
          {"longest_gap_ms", json_of(spread_over(record.rates, &FrameRate::longest_gap_ms))}};
}

std::string table_line(const LatencyRecord& record) {
  const Spread spread = spread_of(record.ms);
  std::string line = fmt::format(
      "{:<8} {:<9} {:>3} events  median {:>6.1f} ms  95 % within {:>6.1f} ms  ({:.1f} - {:.1f})",
      record.scene, record.measure, record.ms.size(), spread.median, quantile(record.ms, 0.95),
      spread.min, spread.max);
  if (record.pictures_per_second > 0) {
    line += fmt::format("  {:.0f} pictures a second while dragging", record.pictures_per_second);
  }
  if (record.unanswered > 0) line += fmt::format("  {} unanswered", record.unanswered);
  return line;
}

std::string table_line(const DragRecord& record) {
  const Spread frames = spread_over(record.rates, &FrameRate::frames_per_second);
  const Spread gap = spread_over(record.rates, &FrameRate::longest_gap_ms);
  return fmt::format(
      "{:<8} {:<9} {:>3} drags   median {:>6.1f} frames a second ({:.1f} - {:.1f})  longest gap "
      "{:.1f} ms ({:.1f} - {:.1f})",
      record.scene, record.measure, record.rates.size(), frames.median, frames.min, frames.max,
      gap.median, gap.min, gap.max);
}

}  // namespace bench
