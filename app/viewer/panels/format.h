// SPDX-License-Identifier: MIT
// Numbers as people read them, in any locale alike.
#pragma once

#include <cstdint>
#include <string>

namespace app {

/// A value and its unit, set in columns of their own.
struct Quantity {
  std::string value;
  std::string unit;
};

/// 1234567 -> "1,234,567".
std::string format_count(uint64_t count);
/// Microseconds to hours, three digits: 0.0123 -> {"12.3", "ms"}.
Quantity format_seconds(double seconds);
/// Three digits, not in powers of ten: 0.0123 -> "0.0123", 41.26 -> "41.3", 1234 -> "1,234".
std::string format_three_digits(double value);
/// 3.4e9 -> {"3.40", "G"}: for large counts that grow while one looks at them.
Quantity format_large(double value);
/// 61.2e6 -> {"61.2", "MB"}.
Quantity format_bytes(uint64_t bytes);
/// "face index 0" -> "Face index 0", "max-depth" -> "Max depth".
std::string format_label(const char* field_name);

}  // namespace app
