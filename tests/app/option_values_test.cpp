// SPDX-License-Identifier: MIT
#include "app/option_values.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace app {
namespace {

using tracer::Vec2i;
using tracer::Vec3d;

TEST(OptionValues, whole_numbers_are_read_whole_or_not_at_all) {
  EXPECT_EQ(parse_whole_number("7", 1, 10), 7);
  EXPECT_EQ(parse_whole_number("+7", 1, 10), 7);
  EXPECT_EQ(parse_whole_number("-3", -5, 10), -3);
  for (const char* text : {"", "x", "7x", " 7", "7.0", "0x7", "1e1", "99999999999", "0", "11"}) {
    EXPECT_THROW(parse_whole_number(text, 1, 10), std::invalid_argument) << text;
  }
}

TEST(OptionValues, numbers_outside_their_range_and_nan_are_refused) {
  EXPECT_EQ(parse_number("-2.5", -20, 20), -2.5);
  EXPECT_EQ(parse_number("1e1", -20, 20), 10);
  for (const char* text : {"", "nan", "inf", "-inf", "1e400", "20.01", "1,5", "2 "}) {
    EXPECT_THROW(parse_number(text, -20, 20), std::invalid_argument) << text;
  }
}

TEST(OptionValues, vectors_have_three_finite_parts) {
  EXPECT_EQ(parse_vec3("1,-2.5,1e3"), Vec3d(1, -2.5, 1000));
  for (const char* text :
       {"", "1", "1,2", "1,2,", "1,2,3,4", ",,", "1,nan,2", "1,2,inf", "1;2;3"}) {
    EXPECT_THROW(parse_vec3(text), std::invalid_argument) << text;
  }
}

TEST(OptionValues, a_sky_is_never_darker_than_black) {
  EXPECT_EQ(parse_sky("0,0.5,20"), Vec3d(0, 0.5, 20));
  EXPECT_THROW(parse_sky("0,-0.1,0"), std::invalid_argument);
}

TEST(OptionValues, sizes_and_pixels_stay_in_their_range) {
  EXPECT_EQ(parse_size_px("1280x720"), Vec2i(1280, 720));
  EXPECT_EQ(parse_size_px("1x65535"), Vec2i(1, 65535));
  for (const char* text :
       {"0x0", "1x0", "65536x1", "99999999x2", "-1x5", "5", "5x", "5X5", "5x5x5"}) {
    EXPECT_THROW(parse_size_px(text), std::invalid_argument) << text;
  }
  EXPECT_EQ(parse_pixel("0,0"), Vec2i(0, 0));
  for (const char* text : {"-1,0", "0,-1", "1", "1,2,3", "1x2", ""}) {
    EXPECT_THROW(parse_pixel(text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace app
