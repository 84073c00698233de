// SPDX-License-Identifier: MIT
#include "tracer/geometry/box.h"

#include <cfloat>

#include <gtest/gtest.h>

namespace tracer {
namespace {

TEST(Box, is_empty_until_extended_and_then_just_that_point) {
  Box box;
  EXPECT_TRUE(box.is_empty());
  box.extend(Vec3f(1, 2, 3));
  EXPECT_FALSE(box.is_empty());
  EXPECT_EQ(box.min, Vec3f(1, 2, 3));
  EXPECT_EQ(box.max, Vec3f(1, 2, 3));
}

TEST(Box, a_miss_is_flt_max_and_minus_flt_max) {
  Box box;
  box.extend(Vec3f(0, 0, 0));
  box.extend(Vec3f(1, 1, 1));
  const auto [entry, exit] = box.intersect({.origin{2, 2, 2}, .direction{1, 0, 0}});
  EXPECT_EQ(entry, FLT_MAX);
  EXPECT_EQ(exit, -FLT_MAX);
}

}  // namespace
}  // namespace tracer
