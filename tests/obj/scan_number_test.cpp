// SPDX-License-Identifier: MIT
#include "tracer/obj/scan_number.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "tracer/obj/parse_number.h"

namespace tracer {
namespace {

/// With a blank behind it, and room to read.
struct Scanned {
  bool is_read = false;
  double value = 0;
  size_t size = 0;
};

Scanned scan(const std::string& text) {
  const std::string padded = text + ' ' + std::string(64, '\0');
  const char* at = padded.data();
  Scanned scanned;
  scanned.is_read = scan_double(at, scanned.value);
  scanned.size = static_cast<size_t>(at - padded.data());
  return scanned;
}

double exact(const std::string& text) {
  return parse_real<double>(text.data(), text.data() + text.size()).value;
}

TEST(ScanNumber, doubles_of_the_usual_forms_are_those_nearest_to_the_text) {
  std::mt19937_64 random(3);
  const char* const formats[] = {"%.6f", "%.3f", "%.0f", "%g", "%.9g", "%.7e", "%.8f", "%.12f"};
  char text[64];
  int read_count = 0;
  for (int i = 0; i < 400'000; ++i) {
    const double size = std::pow(10.0, std::uniform_real_distribution<double>(-8, 7)(random));
    const double value = std::uniform_real_distribution<double>(-size, size)(random);
    std::snprintf(text, sizeof text, formats[i % 8], value);
    const Scanned scanned = scan(text);
    if (!scanned.is_read) continue;
    ++read_count;
    ASSERT_EQ(std::bit_cast<uint64_t>(scanned.value), std::bit_cast<uint64_t>(exact(text))) << text;
    ASSERT_EQ(scanned.size, std::string(text).size()) << text;
  }
  EXPECT_GT(read_count, 320'000);
}

TEST(ScanNumber, what_is_no_number_or_of_a_rarer_form_is_left) {
  for (const char* text : {"", "x", "-", ".", "-.", "+1", ".5", "nan", "inf", "1e", "1e+",
                           "1e99999", "1e30", "1234567890123456", "0.12345678901234567", "--1"}) {
    const Scanned scanned = scan(text);
    EXPECT_FALSE(scanned.is_read) << text;
    EXPECT_EQ(scanned.size, 0u) << text;
  }
}

TEST(ScanNumber, minus_zero_keeps_its_sign) {
  EXPECT_TRUE(std::signbit(scan("-0.000000").value));
  EXPECT_TRUE(std::signbit(scan("-0").value));
}

TEST(ScanNumber, indices_of_one_to_eight_digits_are_read) {
  for (const int32_t value : {1, 9, 10, 12345, 99'999'999, -1, -12345678}) {
    const std::string padded = std::to_string(value) + '/' + std::string(64, '\0');
    const char* at = padded.data();
    EXPECT_EQ(scan_index(at), value);
    EXPECT_EQ(*at, '/');
  }
  for (const char* text : {"x", "", "123456789", "-"}) {
    const std::string padded = std::string(text) + std::string(64, '\0');
    const char* at = padded.data();
    EXPECT_EQ(scan_index(at), 0) << text;
  }
}

TEST(ScanNumber, a_double_tells_its_float_unless_it_lies_between_two) {
  float value = 0;
  EXPECT_TRUE(round_to_float(0.1, value));
  EXPECT_EQ(value, 0.1f);
  EXPECT_TRUE(round_to_float(0, value));
  EXPECT_FALSE(round_to_float(1 + 0x1p-24, value));
  EXPECT_TRUE(round_to_float(1 + 0x1p-24 + 0x1p-52, value));
  EXPECT_EQ(value, 1 + 0x1p-23f);
  EXPECT_FALSE(round_to_float(0x1p-130, value));
}

}  // namespace
}  // namespace tracer
