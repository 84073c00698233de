// SPDX-License-Identifier: MIT
#include "tracer/bvh/quality.h"

#include <gtest/gtest.h>

#include "tests/support/test_meshes.h"
#include "tracer/base/parallel.h"
#include "tracer/bvh/build.h"
#include "tracer/geometry/clip_polygon.h"

namespace tracer {
namespace {

const Progress never_stopped;

BvhTree build(const Mesh& mesh, const Builder& builder, int leaf_size) {
  Progress progress;
  return builder.build(primitive_boxes(mesh), {.max_depth = 64, .leaf_size = leaf_size}, progress);
}

/// A root whose leaves hold one triangle each.
BvhTree tree_of_two(const Mesh& mesh) {
  return build(mesh, builders()[0], 1);
}

Epo epo_of(const BvhTree& tree, const Mesh& mesh, const SahCosts& costs = {}) {
  return measure_epo(tree, mesh, costs, never_stopped);
}

/// The right triangle with legs `size` along x and y at `corner`.
void add_triangle(Mesh& mesh, const Vec3f& corner, float size) {
  const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
  for (const Vec3f& offset : {Vec3f(0), Vec3f(size, 0, 0), Vec3f(0, size, 0)}) {
    mesh.positions.push_back(corner + offset);
  }
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

Mesh triangles_at(const std::vector<std::pair<Vec3f, float>>& corners_and_sizes) {
  Mesh mesh;
  for (const auto& [corner, size] : corners_and_sizes) add_triangle(mesh, corner, size);
  return make_test_mesh(mesh.positions, mesh.triangles);
}

TEST(Epo, of_triangles_apart_is_zero) {
  const Mesh mesh = triangles_at({{Vec3f(0), 1.0f}, {Vec3f(5, 0, 0), 1.0f}});
  EXPECT_EQ(epo_of(tree_of_two(mesh), mesh).value, 0);
}

TEST(Epo, of_boxes_that_touch_at_a_corner_is_zero) {
  const Mesh mesh = triangles_at({{Vec3f(0), 1.0f}, {Vec3f(1, 1, 0), 1.0f}});
  EXPECT_EQ(epo_of(tree_of_two(mesh), mesh).value, 0);
}

TEST(Epo, of_a_single_leaf_is_zero_however_its_triangles_overlap) {
  const Mesh mesh = random_soup(8, 1, 1);
  EXPECT_EQ(epo_of(build(mesh, builders()[0], 8), mesh).value, 0);
}

TEST(Epo, of_a_triangle_that_reaches_into_another_leaf_is_the_part_of_the_area_in_it) {
  // The box of the large triangle, [0, 4]^2, holds all of the small one, 0.5; the box of the small
  // one, [1, 2]^2, lies within the large one, 1. All of the surface is 8.5.
  const Mesh mesh = triangles_at({{Vec3f(0), 4.0f}, {Vec3f(1, 1, 0), 1.0f}});
  const BvhTree tree = tree_of_two(mesh);
  ASSERT_EQ(tree.nodes.size(), 3u);
  EXPECT_DOUBLE_EQ(epo_of(tree, mesh).value, (0.5 + 1) / 8.5);
  EXPECT_EQ(epo_of(tree, mesh).sample_count, 0u) << "all triangles of a small mesh are taken";
}

TEST(Epo, weighs_each_node_with_its_cost) {
  const Mesh mesh =
      triangles_at({{Vec3f(0), 4.0f}, {Vec3f(1, 1, 0), 1.0f}, {Vec3f(1, 1, 0), 1.0f}});
  const Box large{Vec3f(0), Vec3f(4, 4, 0)};
  const Box small{Vec3f(1, 1, 0), Vec3f(2, 2, 0)};
  BvhTree tree;
  tree.nodes = {{large, 1, 0}, {large, 0, 1}, {small, 3, 0}, {small, 1, 1}, {small, 2, 1}};
  tree.primitives = {0, 1, 2};
  // Of the large triangle 1 lies in an inner node and two leaves, of each small one all of its 0.5
  // in the large one's leaf and in the other's.
  const double expected = (1 * (10 + 2 * 3) + 2 * 0.5 * 2 * 3) / 9;
  EXPECT_DOUBLE_EQ(epo_of(tree, mesh, {.traversal = 10, .intersection = 3}).value, expected);
}

TEST(Epo, does_not_count_a_node_that_holds_the_triangle_in_one_of_several_leaves) {
  // The first triangle, of area 2, is cut at x = 1 and in both leaves, as spatial splits do.
  const Mesh mesh = triangles_at({{Vec3f(0), 2.0f}, {Vec3f(1, 0, 1), 1.0f}});
  BvhTree tree;
  tree.nodes = {{mesh.bounds, 1, 0},
                {{Vec3f(0), Vec3f(1, 2, 0)}, 0, 1},
                {{Vec3f(1, 0, 0), Vec3f(2, 1, 1)}, 1, 2}};
  tree.primitives = {0, 0, 1};
  EXPECT_EQ(epo_of(tree, mesh).value, 0);
  // Without the second reference, its 0.5 beyond x = 1 lie in a leaf of two that is not its own.
  tree.primitives = {0, 1, 1};
  EXPECT_DOUBLE_EQ(epo_of(tree, mesh).value, 0.5 * 2 / 2.5);
}

TEST(Epo, of_triangles_without_area_or_of_no_tree_is_zero) {
  const Mesh lines = repeated(triangles_at({{Vec3f(0), 0.0f}}), 100);
  EXPECT_EQ(epo_of(build(lines, builders()[0], 1), lines).value, 0);
  EXPECT_EQ(epo_of({}, Mesh{}).value, 0);
}

/// Straight from the definition: every triangle against every node.
class EpoByDefinition {
 public:
  EpoByDefinition(const BvhTree& tree, const Mesh& mesh) : tree_(tree), mesh_(mesh) {
    for (uint32_t i = 0; i < mesh.triangle_count(); ++i) total_area_ += area(triangle(i));
    visit(0);
  }
  double value() const { return sum_ / total_area_; }

 private:
  Polygon triangle(uint32_t i) const {
    const Vec3u& index = mesh_.triangles[i];
    return make_triangle(mesh_.positions[index.x], mesh_.positions[index.y],
                         mesh_.positions[index.z]);
  }

  // Which triangles are in leaves below.
  std::vector<bool> visit(uint32_t node_index) {
    const BvhNode& node = tree_.nodes[node_index];
    std::vector<bool> is_held(mesh_.triangle_count());
    if (node.is_leaf()) {
      for (uint32_t i = 0; i < node.count; ++i) is_held[tree_.primitives[node.first + i]] = true;
    } else {
      is_held = visit(node.first);
      const std::vector<bool> second = visit(node.first + 1);
      for (size_t i = 0; i < second.size(); ++i) is_held[i] = is_held[i] || second[i];
    }
    for (uint32_t i = 0; i < mesh_.triangle_count(); ++i) {
      if (is_held[i]) continue;
      sum_ += area(clip(triangle(i), node.bounds)) * (node.is_leaf() ? node.count : 1);
    }
    return is_held;
  }

  const BvhTree& tree_;
  const Mesh& mesh_;
  double total_area_ = 0;
  double sum_ = 0;
};

TEST(Epo, of_small_meshes_is_what_the_definition_says) {
  for (const Mesh& mesh : {random_soup(300, 0.3f, 1), lattice_quads(150, 2), rough_ball(6, 0.1f, 3),
                           repeated(random_soup(50, 0.3f, 4), 3)}) {
    for (const Builder& builder : builders()) {
      const BvhTree tree = build(mesh, builder, 2);
      const double expected = EpoByDefinition(tree, mesh).value();
      EXPECT_GT(expected, 0);
      EXPECT_EQ(epo_of(tree, mesh).sample_count, 0u);
      EXPECT_NEAR(epo_of(tree, mesh).value, expected, 1e-10 * expected) << builder.name;
    }
  }
}

TEST(Epo, of_a_sample_is_near_what_the_definition_says) {
  // So many boxes overlap that not all triangles are taken; their areas differ a thousandfold.
  Mesh mesh = random_soup(5000, 1, 3);
  for (uint32_t i = 0; i < 1000; ++i) {
    const Vec3u& index = mesh.triangles[i];
    mesh.positions[index.y] = glm::mix(mesh.positions[index.x], mesh.positions[index.y], 0.03f);
    mesh.positions[index.z] = glm::mix(mesh.positions[index.x], mesh.positions[index.z], 0.03f);
  }
  const BvhTree tree = build(mesh, *find_builder("sweep-sah"), 1);
  const Epo sampled = epo_of(tree, mesh);
  ASSERT_GT(sampled.sample_count, 500u);
  const double expected = EpoByDefinition(tree, mesh).value();
  EXPECT_NEAR(sampled.value, expected, 0.03 * expected);
}

TEST(Lcv, of_a_single_leaf_is_zero) {
  const Mesh mesh = random_soup(8, 1, 1);
  EXPECT_EQ(measure_lcv(build(mesh, builders()[0], 8), never_stopped).value, 0);
  EXPECT_GT(measure_lcv(build(mesh, builders()[0], 8), never_stopped).ray_count, 0u);
}

TEST(Lcv, of_a_leaf_that_half_of_the_lines_meet_is_a_half) {
  // A flat root: all lines meet the one leaf, half of them the other, so 1.5 +- 0.5.
  BvhTree tree;
  const Box whole{Vec3f(0), Vec3f(4, 4, 0)};
  tree.nodes = {{whole, 1, 0}, {whole, 0, 1}, {{Vec3f(0), Vec3f(2, 4, 0)}, 1, 1}};
  tree.primitives = {0, 1};
  EXPECT_NEAR(measure_lcv(tree, never_stopped).value, 0.5, 0.005);
  EXPECT_EQ(measure_lcv(tree, never_stopped).ray_count, 16384u);
}

TEST(Lcv, of_no_tree_or_one_without_area_is_zero) {
  EXPECT_EQ(measure_lcv({}, never_stopped).value, 0);
  const Mesh points = repeated(triangles_at({{Vec3f(1), 0.0f}}), 100);
  EXPECT_EQ(measure_lcv(build(points, builders()[0], 1), never_stopped).value, 0);
}

void expect_same(const TreeQuality& a, const TreeQuality& b, const std::string& what) {
  EXPECT_EQ(a.epo.value, b.epo.value) << what;
  EXPECT_EQ(a.epo.sample_count, b.epo.sample_count) << what;
  EXPECT_EQ(a.lcv.value, b.lcv.value) << what;
}

TEST(Quality, a_model_of_another_scale_has_the_same_bits) {
  const Mesh mesh = random_soup(3000, 0.1f, 5);
  for (const Builder& builder : builders()) {
    const BvhTree tree = build(mesh, builder, 4);
    const TreeQuality expected = measure_quality(tree, mesh, {}, never_stopped);
    EXPECT_GT(expected.epo.value, 0);
    EXPECT_GT(expected.lcv.value, 0);
    for (const float scale : {0x1p-30f, 0x1p40f}) {
      Mesh scaled = mesh;
      for (Vec3f& position : scaled.positions) position *= scale;
      BvhTree scaled_tree = tree;
      for (BvhNode& node : scaled_tree.nodes) {
        node.bounds.min *= scale;
        node.bounds.max *= scale;
      }
      expect_same(measure_quality(scaled_tree, scaled, {}, never_stopped), expected,
                  std::string(builder.name));
      EXPECT_EQ(measure(scaled_tree).sah_cost, measure(tree).sah_cost) << builder.name;
    }
  }
}

TEST(Quality, is_the_same_at_any_number_of_threads) {
  const Mesh mesh = random_soup(50000, 0.2f, 6);
  const BvhTree tree = build(mesh, *find_builder("median"), 4);
  const auto measure_with = [&](int thread_count) {
    return with_thread_count(thread_count,
                             [&] { return measure_quality(tree, mesh, {}, never_stopped); });
  };
  const TreeQuality expected = measure_with(1);
  EXPECT_GT(expected.epo.sample_count, 0u);
  expect_same(measure_with(2), expected, "2 threads");
  expect_same(measure_with(7), expected, "7 threads");
}

TEST(Quality, fewer_rays_are_tried_where_each_meets_thousands_of_nodes) {
  const Mesh mesh = random_soup(20000, 0.5f, 7);
  const uint32_t ray_count = measure_lcv(build(mesh, builders()[0], 4), never_stopped).ray_count;
  EXPECT_GE(ray_count, 1024u);
  EXPECT_LT(ray_count, 16384u);
}

TEST(Quality, of_the_sweep_is_better_than_of_the_median) {
  const Mesh mesh = rough_ball(40, 0.02f, 1);
  const auto quality_of = [&](const char* name) {
    return measure_quality(build(mesh, *find_builder(name), 4), mesh, {}, never_stopped);
  };
  EXPECT_LT(quality_of("sweep-sah").epo.value, quality_of("median").epo.value);
}

TEST(Quality, a_measurement_asked_to_stop_throws_cancelled) {
  const Mesh mesh = random_soup(50000, 0.2f, 6);
  const BvhTree tree = build(mesh, *find_builder("median"), 4);
  Progress progress;
  progress.request_stop();
  EXPECT_THROW(measure_epo(tree, mesh, {}, progress), Cancelled);
  EXPECT_THROW(measure_lcv(tree, progress), Cancelled);
}

}  // namespace
}  // namespace tracer
