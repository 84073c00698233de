// SPDX-License-Identifier: MIT
// Coordinates are multiples of 1/4 and the perimeter is a power of two, so all costs here are exact
// and equality means equality.
#include "tracer/bvh/sah_2d.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/random_source.h"

namespace tracer {
namespace {

constexpr Rectangle box{2, 1, 14, 5};
constexpr double scan_step = 0x1p-5;
constexpr int random_sets = 4000;

std::vector<XInterval> random_triangles(RandomSource& random, int narrowest) {
  std::vector<XInterval> triangles(static_cast<size_t>(random.integer(1, 12)));
  for (XInterval& triangle : triangles) {
    // In quarters of the box's 12 units, some of it outside.
    const int start = random.integer(-2, 48);
    const int width = random.integer(narrowest, 1 << random.integer(0, 5));
    triangle = {box.x0 + 0.25 * start, box.x0 + 0.25 * (start + width)};
  }
  return triangles;
}

struct ScanPoint {
  double d;
  double cost;
};

// Sixteen points and more between any two candidates.
std::vector<ScanPoint> dense_scan(const SahNode2d& node) {
  std::vector<ScanPoint> scan;
  for (double d = box.x0; d <= box.x1; d += scan_step / 2) scan.push_back({d, node.cost(d)});
  return scan;
}

bool is_candidate(const SahNode2d& node, double d) {
  return std::ranges::binary_search(node.candidates(), d);
}

template <class F>
void for_each_random_node(int narrowest, F&& f) {
  RandomSource random(1);
  for (int i = 0; i < random_sets && !testing::Test::HasFatalFailure(); ++i) {
    const std::vector<XInterval> triangles = random_triangles(random, narrowest);
    f(SahNode2d(box, triangles, {.intersection = 2, .traversal = 0.5}), triangles);
  }
}

TEST(Sah2d, agrees_with_the_sheet_on_an_example_by_hand) {
  // Two triangles overlap with the left half, two with the right.
  const std::vector<XInterval> triangles{{2, 5}, {7, 9}, {10, 14}};
  const SahNode2d node(box, triangles, {.intersection = 3, .traversal = 1});
  EXPECT_EQ(node.triangle_count(), 3u);
  EXPECT_EQ(node.left_count(8), 2u);
  EXPECT_EQ(node.right_count(8), 2u);
  EXPECT_EQ(node.left_probability(8), 10 / 16.0);
  EXPECT_EQ(node.right_probability(8), 10 / 16.0);
  EXPECT_EQ(node.cost(8), 3 * (2 * 10 + 2 * 10) / 16.0 + 1);
  EXPECT_EQ(node.cost_without_split(), 9);
  EXPECT_TRUE(std::ranges::equal(node.candidates(), std::vector<double>{2, 5, 7, 9, 10, 14}));
}

TEST(Sah2d, takes_the_near_edge_of_empty_space) {
  const std::vector<XInterval> triangles{{2, 3}, {2.5, 3.5}, {2, 3.25}};
  const auto best = SahNode2d(box, triangles, {}).best_split();
  ASSERT_TRUE(best);
  EXPECT_EQ(best->d, 3.5);
}

TEST(Sah2d, a_node_without_triangles_has_no_split) {
  const SahNode2d node(box, {}, {});
  EXPECT_FALSE(node.best_split());
  EXPECT_EQ(node.cost_without_split(), 0);
  EXPECT_EQ(node.cost(8), 1);
}

TEST(Sah2d, triangles_are_clipped_and_those_outside_are_dropped) {
  const std::vector<XInterval> triangles{{-5, 3}, {12, 99}, {-9, -1}, {15, 16}};
  const SahNode2d node(box, triangles, {});
  EXPECT_EQ(node.triangle_count(), 2u);
  EXPECT_TRUE(std::ranges::equal(node.candidates(), std::vector<double>{2, 3, 12, 14}));
  EXPECT_EQ(node.left_count(box.x0), 0u);
  EXPECT_EQ(node.right_count(box.x1), 0u);
}

TEST(Sah2d, counts_are_those_of_the_definition) {
  for_each_random_node(1, [](const SahNode2d& node, const std::vector<XInterval>& triangles) {
    for (const ScanPoint& point : dense_scan(node)) {
      size_t left = 0;
      size_t right = 0;
      for (const XInterval& triangle : triangles) {
        const double start = std::max(triangle.min, box.x0);
        const double end = std::min(triangle.max, box.x1);
        if (start == end && point.d == start) {
          ++(point.d <= 8 ? left : right);
        } else if (start <= end) {
          left += start < point.d;
          right += end > point.d;
        }
      }
      ASSERT_EQ(node.left_count(point.d), left);
      ASSERT_EQ(node.right_count(point.d), right);
    }
  });
}

TEST(Sah2d, between_candidates_cost_is_monotone_and_flat_just_where_counts_are_equal) {
  for (const int narrowest : {0, 1}) {
    int plateaus = 0;
    for_each_random_node(narrowest, [&](const SahNode2d& node, const auto&) {
      const std::vector<ScanPoint> scan = dense_scan(node);
      for (size_t i = 1; i < scan.size(); ++i) {
        if (is_candidate(node, scan[i - 1].d) || is_candidate(node, scan[i].d)) continue;
        const size_t left = node.left_count(scan[i].d);
        const size_t right = node.right_count(scan[i].d);
        ASSERT_EQ(left < right, scan[i].cost < scan[i - 1].cost);
        ASSERT_EQ(left > right, scan[i].cost > scan[i - 1].cost);
        plateaus += left == right;
      }
    });
    EXPECT_GT(plateaus, 1000);
  }
}

TEST(Sah2d, strict_local_minima_of_a_dense_scan_are_candidates) {
  for (const int narrowest : {0, 1}) {
    int minima = 0;
    for_each_random_node(narrowest, [&](const SahNode2d& node, const auto&) {
      const std::vector<ScanPoint> scan = dense_scan(node);
      for (size_t i = 0; i < scan.size(); ++i) {
        const bool is_below_left = i == 0 || scan[i].cost < scan[i - 1].cost;
        const bool is_below_right = i + 1 == scan.size() || scan[i].cost < scan[i + 1].cost;
        if (!is_below_left || !is_below_right) continue;
        ASSERT_TRUE(is_candidate(node, scan[i].d)) << scan[i].d;
        ++minima;
      }
    });
    EXPECT_GT(minima, random_sets);
  }
}

TEST(Sah2d, the_best_split_costs_no_more_than_any_point_of_a_dense_scan) {
  for (const int narrowest : {0, 1}) {
    for_each_random_node(narrowest, [](const SahNode2d& node, const auto&) {
      const auto best = node.best_split();
      if (!best) return;
      ASSERT_EQ(best->cost, node.cost(best->d));
      for (const ScanPoint& point : dense_scan(node)) ASSERT_LE(best->cost, point.cost);
    });
  }
}

TEST(Sah2d, cost_at_a_jump_is_the_lower_value) {
  for (const int narrowest : {0, 1}) {
    for_each_random_node(narrowest, [](const SahNode2d& node, const auto&) {
      for (const double d : node.candidates()) {
        // The slope is at most the number of triangles times C_I over the perimeter's half.
        const double slack = 2 * static_cast<double>(node.triangle_count()) / 16 * scan_step;
        if (d > box.x0) {
          ASSERT_LE(node.cost(d), node.cost(d - scan_step) + slack);
        }
        if (d < box.x1) {
          ASSERT_LE(node.cost(d), node.cost(d + scan_step) + slack);
        }
      }
    });
  }
}

TEST(Sah2d, minima_lie_at_starts_left_of_the_balance_and_at_ends_right_of_it) {
  for_each_random_node(1, [](const SahNode2d& node, const std::vector<XInterval>& triangles) {
    for (const double d : node.candidates()) {
      // At the sides of the box, and clipped to it, a triangle may have no width.
      if (d <= box.x0 || d >= box.x1) continue;
      const auto count_if = [&](auto predicate) {
        return std::ranges::count_if(triangles, predicate) > 0;
      };
      const bool has_start = count_if([&](const XInterval& t) { return t.min == d; });
      const bool has_end = count_if([&](const XInterval& t) { return t.max == d; });
      const double before = d - scan_step;
      const double after = d + scan_step;
      const bool is_expected = (has_end || node.left_count(before) <= node.right_count(before)) &&
                               (has_start || node.left_count(after) >= node.right_count(after));
      // Every jump outweighs what the slope gains within so small a step.
      const bool is_minimum = node.cost(d) <= node.cost(before) && node.cost(d) <= node.cost(after);
      ASSERT_EQ(is_minimum, is_expected) << d;
    }
  });
}

}  // namespace
}  // namespace tracer
