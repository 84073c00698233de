// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

namespace tracer {

/// A number read from the front of a text; `end` is where reading stopped, the begin of the text
/// where there is no number.
template <class T>
struct Parsed {
  T value = 0;
  const char* end = nullptr;
};

/// The float or double nearest to the decimal text, in every locale: sign, digits, point, exponent,
/// "inf", "nan". Beyond the type's range it is infinite or zero.
template <class T>
Parsed<T> parse_real(const char* begin, const char* end);

/// An optional sign and decimal digits; saturates at the limits of int64_t.
inline Parsed<int64_t> parse_int(const char* begin, const char* end) {
  constexpr int64_t largest = std::numeric_limits<int64_t>::max();
  const char* at = begin;
  const bool is_negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  const char* const first_digit = at;
  int64_t value = 0;
  for (; at != end && *at >= '0' && *at <= '9'; ++at) {
    const int digit = *at - '0';
    value = value > (largest - digit) / 10 ? largest : value * 10 + digit;
  }
  if (at == first_digit) return {0, begin};
  return {is_negative ? -value : value, at};
}

}  // namespace tracer
