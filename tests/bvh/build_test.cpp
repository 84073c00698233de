// SPDX-License-Identifier: MIT
#include "tracer/bvh/build.h"

#include <cstring>
#include <thread>

#include <gtest/gtest.h>

#include "tests/support/large_meshes.h"
#include "tests/support/test_meshes.h"
#include "tracer/base/parallel.h"
#include "tracer/bvh/metrics.h"

namespace tracer {
namespace {

BvhTree build(const Builder& builder, const LargeVector<Box>& boxes,
              const BuildSettings& settings) {
  Progress progress;
  return builder.build(boxes, settings, progress);
}

Box box_at(const Vec3f& center, float half_size) {
  return {center - half_size, center + half_size};
}

LargeVector<Box> clustered_boxes(uint32_t count) {
  // Each cluster a thousandth of the one before: the middle of the box parts few of them.
  RandomSource random(1);
  LargeVector<Box> boxes;
  for (uint32_t i = 0; i < count; ++i) {
    const float scale = std::exp2(-10.0f * static_cast<float>(i % 10));
    boxes.push_back(box_at(scale * random.vector(0, 1), 0.01f * scale));
  }
  return boxes;
}

std::vector<std::pair<std::string, LargeVector<Box>>> box_sets() {
  RandomSource random(2);
  LargeVector<Box> concentric, huge, line, tiny, wide;
  for (int i = 0; i < 300; ++i) {
    tiny.push_back(box_at(1e-38f * random.vector(-1, 1), 1e-42f));
    const Vec3f center = random.vector(-1, 1) * Vec3f(3.4e38f, 1, 1e-30f);
    wide.push_back({center, center});
    concentric.push_back(box_at(Vec3f(0), static_cast<float>(i)));
    huge.push_back({Vec3f(-3e38f) * random.unit(), Vec3f(3e38f) * random.unit()});
    line.push_back(box_at(Vec3f(static_cast<float>(i), 0, 0), 0));
  }
  return {
      {"none", {}},
      {"one", {box_at(Vec3f(1), 1)}},
      {"two", {box_at(Vec3f(1), 1), box_at(Vec3f(-1), 1)}},
      {"soup", primitive_boxes(random_soup(5000, 0.05f, 3))},
      {"many", primitive_boxes(random_soup(40000, 0.01f, 4))},
      {"identical", LargeVector<Box>(1000, box_at(Vec3f(2), 1))},
      {"concentric", concentric},
      {"huge", huge},
      {"line of points", line},
      {"tiny", tiny},
      {"wide", wide},
      {"lattice", primitive_boxes(lattice_quads(500, 5))},
      {"clustered", clustered_boxes(3000)},
  };
}

TEST(Builders, every_tree_is_valid_for_all_settings) {
  for (const auto& [name, boxes] : box_sets()) {
    for (const Builder& builder : builders()) {
      for (const int max_depth : {1, 5, 30, 64}) {
        for (const int leaf_size : {1, 4, 64}) {
          const BvhTree tree = build(builder, boxes, {max_depth, leaf_size});
          ASSERT_EQ(validate(tree, boxes, max_depth), "")
              << builder.name << ", " << name << ", depth " << max_depth << ", leaf " << leaf_size;
        }
      }
    }
  }
}

TEST(Builders, leaves_are_small_where_the_depth_allows) {
  for (const auto& [name, boxes] : box_sets()) {
    // Halving space needs more levels than there are to part what spans thirty octaves.
    if (name == "clustered") continue;
    for (const Builder& builder : builders()) {
      for (const int leaf_size : {1, 4, 64}) {
        const TreeMetrics metrics = measure(build(builder, boxes, {64, leaf_size}));
        EXPECT_LE(metrics.largest_leaf, leaf_size) << builder.name << ", " << name;
      }
    }
  }
}

TEST(Builders, nodes_of_leaf_size_are_not_split) {
  const auto boxes = primitive_boxes(random_soup(64, 0.05f, 3));
  for (const Builder& builder : builders()) {
    EXPECT_EQ(build(builder, boxes, {30, 64}).nodes.size(), 1u);
    EXPECT_EQ(build(builder, boxes, {30, 63}).nodes.size(), 3u);
  }
}

TEST(Builders, a_million_identical_boxes_are_halved_without_wasting_depth) {
  const LargeVector<Box> boxes(1 << 20, box_at(Vec3f(2), 1));
  for (const Builder& builder : builders()) {
    const BvhTree tree = build(builder, boxes, {64, 4});
    EXPECT_EQ(measure(tree).depth, 18) << builder.name;
    EXPECT_EQ(validate(tree, boxes, 18), "") << builder.name;
  }
}

TEST(Builders, all_but_the_median_reach_the_leaf_size_whenever_the_depth_could) {
  const LargeVector<Box> boxes = clustered_boxes(3072);
  for (const Builder& builder : builders()) {
    const uint32_t largest_leaf = measure(build(builder, boxes, {10, 3})).largest_leaf;
    if (builder.name == "median") {
      EXPECT_GT(largest_leaf, 3u);
    } else {
      EXPECT_EQ(largest_leaf, 3u) << builder.name;
    }
  }
}

TEST(Builders, sweep_sah_costs_less_than_the_median) {
  const auto boxes = primitive_boxes(rough_ball(40, 0.02f, 1));
  EXPECT_LT(measure(build(*find_builder("sweep-sah"), boxes, {})).sah_cost,
            measure(build(*find_builder("median"), boxes, {})).sah_cost);
}

TEST(Builders, median_halves_across_the_longest_side) {
  // Centres at 1, 2, 3 and 9 along y; the middle of the box lies at 5.
  LargeVector<Box> boxes;
  for (const float y : {3.0f, 9.0f, 1.0f, 2.0f}) boxes.push_back(box_at({0, y, 0}, 1));
  const BvhTree tree = build(*find_builder("median"), boxes, {1, 1});
  ASSERT_EQ(tree.nodes.size(), 3u);
  EXPECT_EQ(tree.nodes[1].count, 3u);
  ASSERT_EQ(tree.nodes[2].count, 1u);
  EXPECT_EQ(tree.primitives[tree.nodes[2].first], 1u);
}

TEST(Builders, median_splits_centres_that_all_lie_on_one_side_of_the_box) {
  // One large box whose centre is left of the middle, as are all others.
  LargeVector<Box> boxes{{Vec3f(-100, -1, -1), Vec3f(60, 1, 1)}};
  for (const float x : {-99.0f, -98.0f, -97.0f}) boxes.push_back(box_at({x, 0, 0}, 0.1f));
  boxes.push_back(box_at({-30, 0, 0}, 90));
  const BvhTree tree = build(*find_builder("median"), boxes, {30, 1});
  EXPECT_EQ(validate(tree, boxes, 4), "");
}

double sah_cost(const char* builder, const LargeVector<Box>& boxes,
                const BuildSettings& settings = {}) {
  return measure(build(*find_builder(builder), boxes, settings)).sah_cost;
}

void expect_binned_near_sweep(const Mesh& mesh) {
  const auto boxes = primitive_boxes(mesh);
  EXPECT_LE(sah_cost("binned-sah", boxes), 1.02 * sah_cost("sweep-sah", boxes))
      << boxes.size() << " triangles";
}

TEST(Builders, binned_sah_costs_at_most_two_percent_more_than_the_sweep) {
  expect_binned_near_sweep(rough_ball(60, 0.02f, 1));
  expect_binned_near_sweep(random_soup(50000, 0.3f, 2));
  expect_binned_near_sweep(random_soup(50000, 0.01f, 3));
}

TEST(Builders, binned_sah_costs_at_most_two_percent_more_than_the_sweep_on_models) {
  for (const char* model : {"cow.obj", "stanford-bunny.obj"}) {
    const Mesh mesh = read_plain_obj(std::string(BOXWOOD_SHARED_DIR "/models/") + model);
    if (mesh.triangles.empty()) GTEST_SKIP() << model << " is missing";
    expect_binned_near_sweep(mesh);
  }
}

// As an average over points around a dense ball.
double boxes_around_a_point(const char* builder, const LargeVector<Box>& boxes) {
  const BvhTree tree = build(*find_builder(builder), boxes, {});
  constexpr int point_count = 1000;
  RandomSource random(5);
  int around = 0;
  for (int i = 0; i < point_count; ++i) {
    const Vec3f point = random.vector(-1, 1) + Vec3f(0, 1.05f, 0);
    for (const BvhNode& node : tree.nodes) {
      if (glm::all(glm::lessThanEqual(node.bounds.min, point)) &&
          glm::all(glm::lessThanEqual(point, node.bounds.max))) {
        ++around;
      }
    }
  }
  return static_cast<double>(around) / point_count;
}

TEST(Builders, binned_sah_tells_a_dense_model_from_the_wide_floor_it_stands_on) {
  const auto boxes = primitive_boxes(stadium(30));
  EXPECT_LE(boxes_around_a_point("binned-sah", boxes),
            1.1 * boxes_around_a_point("sweep-sah", boxes));
  expect_binned_near_sweep(stadium(30));
}

TEST(Builders, morton_costs_no_more_than_a_third_above_the_sweep) {
  for (const Mesh& mesh : {rough_ball(60, 0.02f, 1), random_soup(50000, 0.01f, 3)}) {
    const auto boxes = primitive_boxes(mesh);
    EXPECT_LE(sah_cost("morton", boxes), 4.0 / 3 * sah_cost("sweep-sah", boxes));
  }
}

TEST(Builders, morton_parts_what_lies_in_one_cell_of_its_curve) {
  // All but one box in a billionth of the bounds.
  auto boxes = primitive_boxes(random_soup(5000, 0.01f, 3));
  for (Box& box : boxes) box = {0x1p-30f * box.min, 0x1p-30f * box.max};
  const double alone = sah_cost("morton", boxes);
  boxes.push_back(box_at(Vec3f(1), 0.5f));
  BvhTree tree = build(*find_builder("morton"), boxes, {});
  ASSERT_EQ(tree.nodes[2].count, 1u);
  // What is below the left child, as a tree of its own; empty leaves cost nothing.
  tree.nodes[0] = tree.nodes[1];
  tree.nodes[1] = tree.nodes[2] = {Box(), 0, 1};
  EXPECT_DOUBLE_EQ(measure(tree).sah_cost, alone);
}

TEST(Builders, binned_trees_of_few_primitives_are_those_of_the_full_sweep) {
  for (uint32_t count = 1; count <= 32; ++count) {
    const auto boxes = primitive_boxes(random_soup(count, 0.5f, count));
    const double sweep = sah_cost("sweep-sah", boxes, {30, 1});
    for (const char* name : {"binned-sah", "spatial-split"}) {
      EXPECT_NEAR(sah_cost(name, boxes, {30, 1}), sweep, 1e-6 * sweep) << name << ' ' << count;
    }
  }
}

TEST(Builders, binned_sah_splits_alike_at_every_scale) {
  const auto boxes = primitive_boxes(random_soup(3000, 0.05f, 7));
  const Builder& builder = *find_builder("binned-sah");
  const BvhTree reference = build(builder, boxes, {});
  for (const float scale : {0x1p-80f, 0x1p-40f, 0x1p60f, 0x1p125f}) {
    LargeVector<Box> scaled_boxes = boxes;
    for (Box& box : scaled_boxes) box = {scale * box.min, scale * box.max};
    EXPECT_EQ(build(builder, scaled_boxes, {}).primitives, reference.primitives) << scale;
  }
}

uint64_t blocks_of_four(const BvhTree& tree) {
  uint64_t blocks = 0;
  for (const BvhNode& node : tree.nodes) blocks += (node.count + 3) / 4;
  return blocks;
}

TEST(Builders, sah_builders_fill_blocks_when_told_their_size) {
  const auto boxes = primitive_boxes(rough_ball(40, 0.02f, 1));
  for (const char* name : {"binned-sah", "sweep-sah", "spatial-split"}) {
    const Builder& builder = *find_builder(name);
    EXPECT_LT(blocks_of_four(build(builder, boxes, {.leaf_size = 8, .block_size = 4})),
              0.95 * static_cast<double>(blocks_of_four(build(builder, boxes, {.leaf_size = 8}))))
        << name;
  }
}

TEST(Builders, those_that_bin_take_any_number_of_bins) {
  const auto boxes = primitive_boxes(random_soup(3000, 0.05f, 7));
  for (const char* name : {"binned-sah", "spatial-split"}) {
    for (const int bins : {-1, 0, 1, 2, 3, 63, 64, 65, 1 << 30}) {
      EXPECT_EQ(validate(build(*find_builder(name), boxes, {.bins = bins}), boxes, 30), "")
          << name << ' ' << bins;
    }
  }
}

TEST(Builders, those_that_bin_find_cheaper_trees_with_more_bins) {
  const auto boxes = primitive_boxes(random_soup(3000, 0.05f, 7));
  for (const char* name : {"binned-sah", "spatial-split"}) {
    EXPECT_LT(sah_cost(name, boxes, {.bins = 64}), 0.98 * sah_cost(name, boxes, {.bins = 2}))
        << name;
  }
}

bool are_same(const BvhTree& a, const BvhTree& b) {
  return a.primitives == b.primitives && a.nodes.size() == b.nodes.size() &&
         std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)) == 0;
}

TEST(Builders, trees_have_the_same_bits_at_any_number_of_threads) {
  const auto boxes = primitive_boxes(random_soup(100000, 0.01f, 6));
  for (const Builder& builder : builders()) {
    const auto build_with = [&](int thread_count) {
      return with_thread_count(thread_count, [&] { return build(builder, boxes, {}); });
    };
    const BvhTree reference = build_with(1);
    EXPECT_TRUE(are_same(build_with(2), reference)) << builder.name;
    EXPECT_TRUE(are_same(build_with(7), reference)) << builder.name;
  }
}

TEST(Builders, a_build_asked_to_stop_throws_cancelled) {
  const auto boxes = primitive_boxes(random_soup(100000, 0.01f, 6));
  for (const Builder& builder : builders()) {
    Progress progress;
    progress.request_stop();
    EXPECT_THROW(builder.build(boxes, {}, progress), Cancelled) << builder.name;
  }
}

TEST(Builders, a_build_in_flight_stops_soon_after_it_is_asked) {
  const auto boxes = primitive_boxes(random_soup(1000000, 0.01f, 6));
  for (const Builder& builder : builders()) {
    Progress progress;
    std::thread watcher([&] {
      while (progress.fraction() < 0.2f) std::this_thread::yield();
      progress.request_stop();
    });
    EXPECT_THROW(builder.build(boxes, {}, progress), Cancelled) << builder.name;
    watcher.join();
    EXPECT_LT(progress.fraction(), 0.9f) << builder.name;
  }
}

TEST(Builders, progress_ends_at_one) {
  const auto boxes = primitive_boxes(random_soup(30000, 0.01f, 6));
  for (const Builder& builder : builders()) {
    for (const int max_depth : {1, 30}) {
      Progress progress;
      builder.build(boxes, {.max_depth = max_depth}, progress);
      EXPECT_EQ(progress.fraction(), 1) << builder.name;
    }
  }
}

TEST(Builders, are_found_by_their_own_name_alone) {
  for (const Builder& builder : builders()) EXPECT_EQ(find_builder(builder.name), &builder);
  EXPECT_EQ(find_builder("no such builder"), nullptr);
  EXPECT_EQ(find_builder(""), nullptr);
}

}  // namespace
}  // namespace tracer
