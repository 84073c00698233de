// SPDX-License-Identifier: MIT
#include "tracer/obj/scan_number.h"

namespace tracer {
namespace {

/// Moves `at` past "e-05" and the like, if it is there, and adds it to `exponent`.
bool scan_exponent(const char*& at, int& exponent) {
  if ((*at | 0x20) != 'e') return true;
  const char* digit = at + 1;
  const bool is_negative = *digit == '-';
  digit += is_negative || *digit == '+';
  const uint64_t digits = load_digits(digit);
  const int count = count_digits(digits);
  if (count == 0 || count > 4) return false;
  const auto written = static_cast<int>(digits_value(digits, count));
  exponent += is_negative ? -written : written;
  at = digit + count;
  return true;
}

}  // namespace

bool scan_rare_double(const char*& at, double& value) {
  using namespace scan_detail;
  const bool is_negative = *at == '-';
  const char* digit = at + is_negative;
  uint64_t digits = load_digits(digit);
  const int whole_count = count_digits(digits);
  if (whole_count == 0 || whole_count == 8) return false;
  uint64_t mantissa = digits_value(digits, whole_count);
  digit += whole_count;
  int exponent = 0;
  if (*digit == '.') {
    digits = load_digits(++digit);
    int count = count_digits(digits);
    if (count > 0) {
      mantissa = mantissa * whole_powers_of_ten[count] + digits_value(digits, count);
      digit += count;
      exponent = -count;
    }
    if (count == 8) {
      digits = load_digits(digit);
      count = count_digits(digits);
      if (whole_count + 8 + count > 15) return false;
      if (count > 0) mantissa = mantissa * whole_powers_of_ten[count] + digits_value(digits, count);
      digit += count;
      exponent -= count;
    }
  }
  if (!scan_exponent(digit, exponent)) return false;
  if (exponent < -largest_exact_power || exponent > largest_exact_power) return false;
  const auto exact = static_cast<double>(static_cast<int64_t>(mantissa));
  const double magnitude =
      exponent <= 0 ? exact / powers_of_ten[-exponent] : exact * powers_of_ten[exponent];
  value = is_negative ? -magnitude : magnitude;
  at = digit;
  return true;
}

}  // namespace tracer
