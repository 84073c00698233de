// SPDX-License-Identifier: MIT
#include "app/viewer/panels/format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

namespace app {

std::string format_count(uint64_t count) {
  std::string digits = std::to_string(count);
  for (size_t from_end = 3; from_end < digits.size(); from_end += 4) {
    digits.insert(digits.size() - from_end, 1, ',');
  }
  return digits;
}

std::string format_three_digits(double value) {
  if (!std::isfinite(value)) return "-";
  if (value == 0) return "0";
  if (std::abs(value) >= 999.5) {
    const std::string digits = format_count(static_cast<uint64_t>(std::llround(std::abs(value))));
    return value < 0 ? '-' + digits : digits;
  }
  // The rounding may carry into one digit more: 9.996 is 10.0.
  const int exponent = std::stoi(fmt::format("{:.2e}", value).substr(value < 0 ? 6 : 5));
  return fmt::format("{:.{}f}", value, std::max(0, 2 - exponent));
}

Quantity format_seconds(double seconds) {
  if (seconds == 0) return {"0", "s"};
  if (seconds < 0.9995e-3) return {format_three_digits(seconds * 1e6), "µs"};
  if (seconds < 0.9995) return {format_three_digits(seconds * 1e3), "ms"};
  if (seconds < 60) return {format_three_digits(seconds), "s"};
  const auto whole = static_cast<int64_t>(seconds);
  if (whole < 3600) return {fmt::format("{}:{:02}", whole / 60, whole % 60), "min"};
  return {fmt::format("{}:{:02}", whole / 3600, whole / 60 % 60), "h"};
}

Quantity format_large(double value) {
  struct Prefix {
    double factor;
    const char* name;
  };
  constexpr std::array<Prefix, 4> prefixes{{{1e12, "T"}, {1e9, "G"}, {1e6, "M"}, {1e3, "k"}}};
  for (const Prefix& prefix : prefixes) {
    if (value >= 0.9995 * prefix.factor) {
      return {format_three_digits(value / prefix.factor), prefix.name};
    }
  }
  return {format_three_digits(value), ""};
}

Quantity format_bytes(uint64_t bytes) {
  const Quantity size = format_large(static_cast<double>(bytes));
  return {size.value, size.unit + 'B'};
}

std::string format_label(const char* field_name) {
  std::string label = field_name;
  std::replace(label.begin(), label.end(), '-', ' ');
  if (!label.empty()) label[0] = static_cast<char>(std::toupper(label[0]));
  return label;
}

}  // namespace app
