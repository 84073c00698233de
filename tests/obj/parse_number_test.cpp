// SPDX-License-Identifier: MIT
#include "tracer/obj/parse_number.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace tracer {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double value_of(std::string_view text) {
  const Parsed<double> parsed = parse_real<double>(text.data(), text.data() + text.size());
  EXPECT_EQ(parsed.end, text.data() + text.size()) << text;
  return parsed.value;
}

bool is_number(std::string_view text) {
  return parse_real<double>(text.data(), text.data() + text.size()).end != text.data();
}

int64_t int_of(std::string_view text) {
  return parse_int(text.data(), text.data() + text.size()).value;
}

TEST(ParseNumber, doubles_survive_printing_and_parsing_bit_for_bit) {
  std::mt19937_64 random(1);
  char text[64];
  for (int i = 0; i < 100'000; ++i) {
    const auto value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    const int size = std::snprintf(text, sizeof text, "%.17g", value);
    const double parsed = value_of({text, static_cast<size_t>(size)});
    ASSERT_EQ(std::bit_cast<uint64_t>(parsed), std::bit_cast<uint64_t>(value)) << text;
  }
}

TEST(ParseNumber, short_decimals_are_correctly_rounded) {
  std::mt19937_64 random(2);
  char text[64];
  for (int i = 0; i < 100'000; ++i) {
    const double value = std::uniform_real_distribution<double>(-1000, 1000)(random);
    const int size = std::snprintf(text, sizeof text, "%.6f", value);
    ASSERT_EQ(value_of({text, static_cast<size_t>(size)}), std::strtod(text, nullptr)) << text;
  }
}

TEST(ParseNumber, takes_every_usual_form) {
  EXPECT_EQ(value_of("1"), 1);
  EXPECT_EQ(value_of("+1.5"), 1.5);
  EXPECT_EQ(value_of("-.5"), -0.5);
  EXPECT_EQ(value_of("5."), 5);
  EXPECT_EQ(value_of("1e3"), 1000);
  EXPECT_EQ(value_of("1E+3"), 1000);
  EXPECT_EQ(value_of("-2.5e-1"), -0.25);
  EXPECT_TRUE(std::signbit(value_of("-0")));
}

TEST(ParseNumber, what_is_too_large_is_infinite) {
  EXPECT_EQ(value_of("1e400"), infinity);
  EXPECT_EQ(value_of("-1e400"), -infinity);
  EXPECT_EQ(value_of("+1e99999999999999999999"), infinity);
  EXPECT_EQ(value_of("0.0001e400"), infinity);
  EXPECT_EQ(value_of(std::string(400, '9')), infinity);
}

TEST(ParseNumber, what_is_too_small_is_zero_or_denormal) {
  EXPECT_EQ(value_of("1e-400"), 0);
  EXPECT_EQ(value_of("1000e-400"), 0);
  EXPECT_TRUE(std::signbit(value_of("-1e-400")));
  EXPECT_EQ(value_of("1e-99999999999999999999"), 0);
  EXPECT_EQ(value_of("0." + std::string(400, '0') + "1"), 0);
  EXPECT_EQ(value_of("5e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(value_of("0e400"), 0);
}

TEST(ParseNumber, nan_and_infinity_are_numbers) {
  EXPECT_TRUE(std::isnan(value_of("nan")));
  EXPECT_TRUE(std::isnan(value_of("-NaN")));
  EXPECT_EQ(value_of("inf"), infinity);
  EXPECT_EQ(value_of("-Infinity"), -infinity);
}

TEST(ParseNumber, what_is_no_number_is_not_read) {
  for (const char* text : {"", "+", "-", ".", "x", "+-1", "e5", "--1", "n", "\xff"}) {
    EXPECT_FALSE(is_number(text)) << text;
  }
}

TEST(ParseNumber, reading_stops_where_the_number_ends) {
  const std::string_view text = "12.5/7";
  const Parsed<double> parsed = parse_real<double>(text.data(), text.data() + text.size());
  EXPECT_EQ(parsed.value, 12.5);
  EXPECT_EQ(parsed.end, text.data() + 4);
}

TEST(ParseNumber, whole_numbers_saturate) {
  EXPECT_EQ(int_of("42"), 42);
  EXPECT_EQ(int_of("-42"), -42);
  EXPECT_EQ(int_of("+42"), 42);
  EXPECT_EQ(int_of("99999999999999"), 99'999'999'999'999);
  EXPECT_EQ(int_of("9223372036854775807"), std::numeric_limits<int64_t>::max());
  EXPECT_EQ(int_of("9999999999999999999999"), std::numeric_limits<int64_t>::max());
  EXPECT_EQ(int_of("-9999999999999999999999"), -std::numeric_limits<int64_t>::max());
}

}  // namespace
}  // namespace tracer
