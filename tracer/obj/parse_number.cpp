// SPDX-License-Identifier: MIT
#include "tracer/obj/parse_number.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace tracer {
namespace {

constexpr int64_t huge_exponent = 1'000'000'000'000;

/// The power of ten of the leading nonzero digit of a decimal number without its sign.
int64_t decimal_exponent(std::string_view text) {
  const size_t mantissa_size = std::min(text.find_first_of("eE"), text.size());
  const std::string_view mantissa = text.substr(0, mantissa_size);
  const auto point = static_cast<int64_t>(std::min(mantissa.find('.'), mantissa.size()));
  const auto leading = static_cast<int64_t>(mantissa.find_first_of("123456789"));
  const int64_t place = leading < point ? point - leading - 1 : point - leading;
  if (mantissa_size == text.size()) return place;
  const char* const exponent = text.data() + mantissa_size + 1;
  const int64_t written = parse_int(exponent, text.data() + text.size()).value;
  return place + std::clamp(written, -huge_exponent, huge_exponent);
}

/// The limit that a number beyond the range of T tends to.
template <class T>
T out_of_range_value(std::string_view text) {
  const bool is_negative = text.front() == '-';
  const bool is_large = decimal_exponent(text.substr(is_negative ? 1 : 0)) > 0;
  const T magnitude = is_large ? std::numeric_limits<T>::infinity() : T(0);
  return is_negative ? -magnitude : magnitude;
}

}  // namespace

template <class T>
Parsed<T> parse_real(const char* begin, const char* end) {
  const char* first = begin;
  if (first != end && *first == '+') {
    ++first;
    if (first != end && *first == '-') return {0, begin};
  }
  T value = 0;
  const auto [last, error] = std::from_chars(first, end, value);
  if (error == std::errc::invalid_argument) return {0, begin};
  if (error == std::errc::result_out_of_range) {
    value = out_of_range_value<T>({first, static_cast<size_t>(last - first)});
  }
  return {value, last};
}

template Parsed<float> parse_real(const char* begin, const char* end);
template Parsed<double> parse_real(const char* begin, const char* end);

}  // namespace tracer
