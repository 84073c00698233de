// SPDX-License-Identifier: MIT
#include "tracer/bvh/uniform_lines.h"

#include <gtest/gtest.h>

namespace tracer {
namespace {

constexpr uint32_t line_count = 100000;

double part_that_meets(const Box& inner, const Box& outer) {
  uint32_t met = 0;
  for (uint32_t i = 0; i < line_count; ++i) {
    const auto [entry, exit] = inner.intersect(uniform_line(outer, i));
    met += entry <= exit;
  }
  return static_cast<double>(met) / line_count;
}

TEST(UniformLines, all_meet_their_box) {
  for (const Vec3f& size : {Vec3f(1), Vec3f(100, 1, 3), Vec3f(0, 2, 3), Vec3f(2, 0, 0.5f)}) {
    const Box box{Vec3f(-1), Vec3f(-1) + size};
    EXPECT_EQ(part_that_meets(box, box), 1);
  }
}

TEST(UniformLines, meet_a_box_inside_as_often_as_its_surface_says) {
  // [MacDonald 1990]: the very assumption of the surface area heuristic.
  const Box outer{Vec3f(0), Vec3f(4, 2, 1)};
  const Box inners[] = {{Vec3f(0), Vec3f(1)},
                        {Vec3f(1, 0.5f, 0.25f), Vec3f(3, 1.5f, 0.75f)},
                        {Vec3f(3.9f, 0, 0), Vec3f(4, 2, 1)},
                        {Vec3f(0, 0, 0.5f), Vec3f(4, 2, 0.5f)}};
  for (const Box& inner : inners) {
    EXPECT_NEAR(part_that_meets(inner, outer), inner.half_area() / outer.half_area(), 0.006);
  }
}

TEST(UniformLines, are_the_same_for_the_same_index_and_differ_for_others) {
  const Box box{Vec3f(0), Vec3f(1)};
  EXPECT_EQ(uniform_line(box, 7).direction, uniform_line(box, 7).direction);
  EXPECT_NE(uniform_line(box, 7).direction, uniform_line(box, 8).direction);
}

}  // namespace
}  // namespace tracer
