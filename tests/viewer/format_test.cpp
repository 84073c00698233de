// SPDX-License-Identifier: MIT
#include "app/viewer/panels/format.h"

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(Format, counts_are_grouped_by_thousands) {
  EXPECT_EQ(format_count(0), "0");
  EXPECT_EQ(format_count(999), "999");
  EXPECT_EQ(format_count(1000), "1,000");
  EXPECT_EQ(format_count(1234567), "1,234,567");
}

TEST(Format, three_digits_are_kept_even_where_rounding_carries) {
  EXPECT_EQ(format_three_digits(0), "0");
  EXPECT_EQ(format_three_digits(0.012345), "0.0123");
  EXPECT_EQ(format_three_digits(9.996), "10.0");
  EXPECT_EQ(format_three_digits(41.26), "41.3");
  EXPECT_EQ(format_three_digits(999.4), "999");
  EXPECT_EQ(format_three_digits(1234.5), "1,235");
  EXPECT_EQ(format_three_digits(-2.5), "-2.50");
}

TEST(Format, times_change_their_unit_where_digits_would_run_out) {
  EXPECT_EQ(format_seconds(2.5e-5).value + format_seconds(2.5e-5).unit, "25.0µs");
  EXPECT_EQ(format_seconds(0.0123).value + format_seconds(0.0123).unit, "12.3ms");
  EXPECT_EQ(format_seconds(0.99960).value + format_seconds(0.99960).unit, "1.00s");
  EXPECT_EQ(format_seconds(75).value + format_seconds(75).unit, "1:15min");
  EXPECT_EQ(format_seconds(7260).value + format_seconds(7260).unit, "2:01h");
}

TEST(Format, large_counts_take_a_prefix) {
  EXPECT_EQ(format_large(950).value, "950");
  EXPECT_EQ(format_large(7423456).value + format_large(7423456).unit, "7.42M");
  EXPECT_EQ(format_bytes(61204000).value + format_bytes(61204000).unit, "61.2MB");
}

TEST(Format, field_names_become_labels) {
  EXPECT_EQ(format_label("max-depth"), "Max depth");
}

}  // namespace
}  // namespace app
