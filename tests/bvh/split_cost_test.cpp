// SPDX-License-Identifier: MIT
#include "tracer/bvh/build/split_cost.h"

#include <cfloat>

#include <gtest/gtest.h>

namespace tracer {
namespace {

TEST(SplitCost, sides_are_limited_only_where_the_levels_left_just_suffice) {
  EXPECT_EQ(side_limit(8, 4, 1), 4u);
  EXPECT_EQ(side_limit(9, 4, 1), 9u);  // cannot be reached: any split will do
  EXPECT_EQ(side_limit(9, 4, 2), 8u);
  EXPECT_EQ(side_limit(5, 4, 64), 5u);
}

TEST(SplitCost, where_cuts_make_room_for_more_a_side_may_have_more) {
  EXPECT_EQ(side_limit(8, 12, 4, 1), 4u);
  EXPECT_EQ(side_limit(9, 12, 4, 1), 12u);
  EXPECT_EQ(side_limit(5, 12, 4, 64), 12u);
}

TEST(SplitCost, blocks_are_rounded_up) {
  for (int size = 1; size <= 16; ++size) {
    const BlockCount block_count({.block_size = size});
    for (uint32_t count = 0; count < 5000; ++count) {
      const auto whole = static_cast<uint32_t>(size);
      ASSERT_EQ(block_count(count), static_cast<float>((count + whole - 1) / whole))
          << count << " by " << size;
    }
  }
}

TEST(SplitCost, scaled_boxes_reach_no_farther_than_one) {
  for (const float size : {FLT_MAX, 1.0f, 3.0f, 1e-20f, FLT_MIN}) {
    const float scaled_size = size * unit_scale({Vec3f(-size, 0, 0), Vec3f(0)});
    EXPECT_LT(scaled_size, 1) << size;
    EXPECT_GE(scaled_size, 0.25f) << size;
  }
  EXPECT_TRUE(std::isfinite(unit_scale({Vec3f(0), Vec3f(0)})));
  EXPECT_TRUE(std::isfinite(unit_scale({Vec3f(0), Vec3f(1e-45f)})));
}

TEST(SplitCost, areas_come_in_the_order_of_their_boxes) {
  const Box boxes[] = {
      {Vec3f(0), Vec3f(1, 2, 3)}, {Vec3f(-1), Vec3f(4, 0, 9)}, {Vec3f(5), Vec3f(5, 6, 7)}};
  const Float4 areas = half_areas(Box4(boxes[0]), Box4(boxes[1]), Box4(boxes[2]));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(areas[i], boxes[i].half_area()) << i;
}

TEST(SplitCost, the_most_even_of_equal_splits_is_best) {
  BestSplits best;
  const Float4 one{1, 1, 1, 1};
  const Int4 all = ~Int4{};
  best.offer(one, 3 * one, one, one, Int4{3, 3, 3, 3}, all, 1);
  best.offer(one, 2 * one, one, 2 * one, Int4{2, 2, 2, 2}, Int4{0, -1, 0, 0}, 2);
  best.offer(one, one, one, 3 * one, Int4{3, 3, 3, 3}, all, 3);
  EXPECT_EQ(best.axis(), 1);
  EXPECT_EQ(best.place(), 2);
}

TEST(SplitCost, nothing_offered_leaves_no_place) {
  EXPECT_EQ(BestSplits().place(), 0);
}

}  // namespace
}  // namespace tracer
