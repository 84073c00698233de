// SPDX-License-Identifier: MIT
#include "tracer/bvh/build/reinsertion.h"

#include <cstring>

#include <gtest/gtest.h>

#include "tests/support/test_meshes.h"
#include "tracer/base/parallel.h"
#include "tracer/bvh/build.h"
#include "tracer/bvh/metrics.h"
#include "tracer/bvh/trace/accel.h"

namespace tracer {
namespace {

BvhTree build(const char* builder, const Mesh& mesh, const BuildSettings& settings = {}) {
  const auto boxes = primitive_boxes(mesh);
  Progress progress;
  return find_builder(builder)->build(mesh_primitives(mesh, boxes), settings, progress);
}

BvhTree reinserted(BvhTree tree, int round_count, const BuildSettings& settings = {}) {
  Progress progress;
  for (int round = 0; round < round_count; ++round) tree = reinsert(tree, settings, progress);
  return tree;
}

std::string fault_of(const BvhTree& tree, const Mesh& mesh, int max_depth) {
  const auto boxes = primitive_boxes(mesh);
  return validate(tree, mesh_primitives(mesh, boxes), max_depth);
}

bool are_same(const BvhTree& a, const BvhTree& b) {
  return a.primitives == b.primitives && a.nodes.size() == b.nodes.size() &&
         std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)) == 0;
}

TEST(Reinsertion, every_round_lowers_the_cost_or_changes_nothing) {
  for (const char* builder : {"median", "sweep-sah", "spatial-split"}) {
    BvhTree tree = build(builder, random_soup(5000, 0.1f, 1));
    for (int round = 0; round < 10; ++round) {
      const BvhTree next = reinserted(tree, 1);
      if (!are_same(next, tree)) {
        EXPECT_LT(measure(next).sah_cost, measure(tree).sah_cost);
      }
      tree = next;
    }
  }
}

TEST(Reinsertion, mends_a_part_of_what_the_median_lacks) {
  const Mesh mesh = random_soup(5000, 0.1f, 1);
  const BvhTree tree = build("median", mesh);
  const double cost = measure(tree).sah_cost;
  const double least_cost = measure(build("sweep-sah", mesh)).sah_cost;
  EXPECT_LT(measure(reinserted(tree, 10)).sah_cost, 0.9 * cost + 0.1 * least_cost);
}

TEST(Reinsertion, keeps_every_tree_valid) {
  for (const Mesh& mesh : {random_soup(3000, 0.2f, 2), rough_ball(15, 0.1f, 3),
                           lattice_quads(500, 4), repeated(random_soup(10, 1, 5), 40)}) {
    for (const char* builder : {"median", "sweep-sah", "spatial-split"}) {
      for (const int max_depth : {10, 30, 64}) {
        const BuildSettings settings{.max_depth = max_depth, .leaf_size = 2};
        const BvhTree tree = build(builder, mesh, settings);
        for (const int rounds : {1, 5}) {
          EXPECT_EQ(fault_of(reinserted(tree, rounds, settings), mesh, max_depth), "") << builder;
        }
      }
    }
  }
}

TEST(Reinsertion, leaves_the_smallest_trees_as_they_are) {
  EXPECT_TRUE(reinserted({}, 1).nodes.empty());
  for (const uint32_t count : {1u, 2u, 3u, 4u}) {
    const Mesh mesh = random_soup(count, 1, 6);
    const BvhTree tree = build("median", mesh, {.max_depth = 30, .leaf_size = 1});
    EXPECT_EQ(fault_of(reinserted(tree, 3), mesh, 30), "") << count;
  }
}

TEST(Reinsertion, has_the_same_bits_at_any_number_of_threads) {
  const BvhTree tree = build("median", random_soup(60000, 0.02f, 7));
  const auto reinserted_with = [&](int thread_count) {
    return with_thread_count(thread_count, [&] { return reinserted(tree, 2); });
  };
  const BvhTree reference = reinserted_with(1);
  EXPECT_FALSE(are_same(reference, tree));
  EXPECT_TRUE(are_same(reinserted_with(2), reference));
  EXPECT_TRUE(are_same(reinserted_with(7), reference));
}

TEST(Reinsertion, hits_keep_their_bits) {
  const auto mesh = std::make_shared<const Mesh>(random_soup(3000, 0.2f, 8));
  for (const char* builder : {"median", "spatial-split"}) {
    const BvhTree tree = build(builder, *mesh);
    Progress progress;
    const StopFlag stop;
    const Accel before = make_accel(mesh, tree, layouts().front(), progress);
    const Accel after = make_accel(mesh, reinserted(tree, 3), layouts().front(), progress);
    RayCaster expected(before, stop);
    RayCaster found(after, stop);
    RandomSource random(9);
    for (int i = 0; i < 5000; ++i) {
      const Ray ray{.origin = random.vector(-2, 2), .direction = random.vector(-1, 1)};
      const Hit a = expected.closest_hit(ray);
      const Hit b = found.closest_hit(ray);
      ASSERT_TRUE(a.primitive == b.primitive && a.t == b.t && a.u == b.u && a.v == b.v) << i;
    }
  }
}

TEST(Reinsertion, asked_to_stop_throws_cancelled) {
  const BvhTree tree = build("median", random_soup(1000, 0.1f, 1));
  Progress progress;
  progress.request_stop();
  EXPECT_THROW(reinsert(tree, {}, progress), Cancelled);
}

}  // namespace
}  // namespace tracer
