// SPDX-License-Identifier: MIT
#include <cstring>
#include <thread>

#include <gtest/gtest.h>

#include "tests/support/test_meshes.h"
#include "tracer/base/parallel.h"
#include "tracer/bvh/build.h"
#include "tracer/bvh/metrics.h"
#include "tracer/bvh/trace/accel.h"

namespace tracer {
namespace {

// Long, thin and askew: their boxes overlap whatever is done with them whole.
Mesh needles(uint32_t count, uint32_t seed) {
  RandomSource random(seed);
  std::vector<Vec3f> positions;
  std::vector<Vec3u> triangles;
  for (uint32_t i = 0; i < count; ++i) {
    const Vec3f center = random.vector(-0.2f, 0.2f);
    const Vec3f half = 0.5f * glm::normalize(Vec3f(1) + random.vector(-0.2f, 0.2f));
    for (const Vec3f& corner : {center - half, center + half, center + random.vector(0, 0.001f)}) {
      positions.push_back(corner);
    }
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return make_test_mesh(std::move(positions), std::move(triangles));
}

BvhTree build(const Mesh& mesh, const BuildSettings& settings = {}) {
  const auto boxes = primitive_boxes(mesh);
  Progress progress;
  return find_builder("spatial-split")->build(mesh_primitives(mesh, boxes), settings, progress);
}

std::string fault_of(const BvhTree& tree, const Mesh& mesh, int max_depth) {
  const auto boxes = primitive_boxes(mesh);
  return validate(tree, mesh_primitives(mesh, boxes), max_depth);
}

TEST(SpatialSplit, trees_are_valid_and_cover_every_triangle_for_all_settings) {
  const std::pair<const char*, Mesh> meshes[] = {
      {"needles", needles(2000, 1)},
      {"soup", random_soup(2000, 0.3f, 2)},
      {"far", moved(needles(1000, 3), {1e4f, -3e4f, 10})},
      {"ball", rough_ball(20, 0.1f, 4)},
      {"lattice", lattice_quads(1000, 5)},
      {"coincident", repeated(needles(20, 6), 50)},
  };
  for (const auto& [name, mesh] : meshes) {
    for (const int max_depth : {1, 9, 30, 64}) {
      for (const int leaf_size : {1, 4, 64}) {
        for (const double split_budget : {0.0, 0.1, 2.0}) {
          const BvhTree tree = build(
              mesh, {.max_depth = max_depth, .leaf_size = leaf_size, .split_budget = split_budget});
          ASSERT_EQ(fault_of(tree, mesh, max_depth), "")
              << name << ", depth " << max_depth << ", leaf " << leaf_size << ", budget "
              << split_budget;
          EXPECT_LE(static_cast<double>(tree.primitives.size()),
                    (1 + split_budget) * mesh.triangle_count());
        }
      }
    }
  }
}

TEST(SpatialSplit, cuts_needles_and_lowers_the_cost) {
  const Mesh mesh = needles(20000, 1);
  const BvhTree whole = build(mesh, {.split_budget = 0});
  const BvhTree cut = build(mesh);
  EXPECT_EQ(whole.primitives.size(), 20000u);
  EXPECT_GT(cut.primitives.size(), 22000u);
  EXPECT_LT(measure(cut).sah_cost, 0.98 * measure(whole).sah_cost);
}

TEST(SpatialSplit, leaves_alone_what_does_not_overlap) {
  const BvhTree tree = build(rough_ball(30, 0, 1));
  EXPECT_LT(tree.primitives.size(), 1.02 * 12 * 30 * 30);
}

TEST(SpatialSplit, leaves_reach_the_leaf_size_where_the_depth_allows) {
  for (const int max_depth : {11, 14, 64}) {
    EXPECT_LE(measure(build(needles(4000, 2), {.max_depth = max_depth})).largest_leaf, 4u);
  }
}

bool are_same(const BvhTree& a, const BvhTree& b) {
  return a.primitives == b.primitives && a.nodes.size() == b.nodes.size() &&
         std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)) == 0;
}

TEST(SpatialSplit, trees_have_the_same_bits_at_any_number_of_threads) {
  const Mesh mesh = needles(100000, 7);
  const auto build_with = [&](int thread_count) {
    return with_thread_count(thread_count, [&] { return build(mesh); });
  };
  const BvhTree reference = build_with(1);
  EXPECT_GT(reference.primitives.size(), 100000u);
  EXPECT_TRUE(are_same(build_with(2), reference));
  EXPECT_TRUE(are_same(build_with(7), reference));
}

TEST(SpatialSplit, cut_triangles_give_the_bits_of_brute_force) {
  const auto mesh = std::make_shared<const Mesh>(needles(2000, 9));
  const BvhTree tree = build(*mesh, {.split_budget = 2});
  ASSERT_GT(tree.primitives.size(), 2200u);
  Progress progress;
  const Accel brute_force{mesh};
  for (const Layout& layout : layouts()) {
    const Accel accel = make_accel(mesh, tree, layout, progress);
    const StopFlag stop;
    RayCaster expected(brute_force, stop);
    RayCaster found(accel, stop);
    RandomSource random(3);
    int hits = 0;
    for (int i = 0; i < 4000; ++i) {
      const auto triangle = static_cast<uint32_t>(random.integer(0, 1999));
      const Vec3f target =
          glm::mix(mesh->positions[3 * triangle], mesh->positions[3 * triangle + 1], random.unit());
      const Vec3f origin = random.vector(-1, 1);
      const Ray ray{.origin = origin, .direction = target - origin};
      const Hit a = expected.closest_hit(ray);
      const Hit b = found.closest_hit(ray);
      ASSERT_EQ(a.primitive, b.primitive) << layout.name << ", ray " << i;
      ASSERT_TRUE(a.t == b.t && a.u == b.u && a.v == b.v) << layout.name << ", ray " << i;
      ASSERT_EQ(found.occluded(ray), a.is_hit());
      hits += a.is_hit();
    }
    EXPECT_GT(hits, 1000);
  }
}

TEST(SpatialSplit, validation_finds_a_gap_in_a_cut_triangle) {
  const Mesh mesh = needles(2000, 1);
  const BvhTree tree = build(mesh);
  int tampered = 0;
  for (size_t i = 0; i < tree.nodes.size(); ++i) {
    const BvhNode& node = tree.nodes[i];
    if (!node.is_leaf() || node.bounds.half_area() < 1e-3) continue;
    BvhTree faulty = tree;
    Box& bounds = faulty.nodes[i].bounds;
    const int axis = bounds.longest_axis();
    bounds.max[axis] = 0.5f * (bounds.min[axis] + bounds.max[axis]);
    // Its ancestors are made to fit again, so that only the gap can be found.
    for (size_t j = tree.nodes.size(); j-- > 0;) {
      BvhNode& above = faulty.nodes[j];
      if (above.is_leaf()) continue;
      above.bounds = faulty.nodes[above.first].bounds;
      above.bounds.extend(faulty.nodes[above.first + 1].bounds);
    }
    EXPECT_NE(fault_of(faulty, mesh, 64), "") << i;
    if (++tampered == 20) break;
  }
  EXPECT_EQ(tampered, 20);
}

TEST(SpatialSplit, a_build_in_flight_stops_soon_after_it_is_asked) {
  const Mesh mesh = needles(200000, 7);
  const auto boxes = primitive_boxes(mesh);
  Progress progress;
  std::thread watcher([&] {
    while (progress.fraction() < 0.2f) std::this_thread::yield();
    progress.request_stop();
  });
  EXPECT_THROW(find_builder("spatial-split")->build(mesh_primitives(mesh, boxes), {}, progress),
               Cancelled);
  watcher.join();
  EXPECT_LT(progress.fraction(), 0.9f);
}

}  // namespace
}  // namespace tracer
