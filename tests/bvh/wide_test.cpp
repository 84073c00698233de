// SPDX-License-Identifier: MIT
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/instruction_sets.h"
#include "tests/support/random_source.h"
#include "tests/support/test_meshes.h"
#include "tracer/bvh/build.h"
#include "tracer/bvh/trace/accel.h"
#include "tracer/bvh/trace/wide_kernels.h"

namespace tracer {
namespace {

Mesh scaled(Mesh mesh, float factor) {
  for (Vec3f& position : mesh.positions) position *= factor;
  return make_test_mesh(mesh.positions, mesh.triangles);
}

Mesh teapot_in_a_stadium() {
  Mesh mesh = moved(scaled(random_soup(2000, 0.1f, 3), 1e-3f), {3, 2, 1});
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {{-1e4f, 0, -1e4f}, {1e4f, 0, -1e4f}, {0, 0, 1e4f}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  return make_test_mesh(mesh.positions, mesh.triangles);
}

// Aims at interiors, edges and vertices, also along axes, from on the surface to far away.
Ray aimed_ray(const Mesh& mesh, RandomSource& random) {
  const auto last = static_cast<int>(mesh.triangle_count()) - 1;
  const Vec3u& triangle = mesh.triangles[static_cast<size_t>(random.integer(0, last))];
  const Vec3f a = mesh.positions[triangle.x];
  const Vec3f to_b = mesh.positions[triangle.y] - a;
  const Vec3f to_c = mesh.positions[triangle.z] - a;
  const float s = random.unit();
  const float r = random.unit() * (1 - s);
  const Vec3f targets[] = {a, a + s * to_b, a + s * to_b + r * to_c};
  const float distances[] = {0, 1, 30, 1000, 1e6f, 1e9f};
  const float distance =
      static_cast<float>(glm::length(Vec3d(to_b))) * distances[random.integer(0, 5)];
  Vec3f direction = random.vector(-1, 1);
  if (random.integer(0, 3) == 0) direction[random.integer(0, 2)] = 0;
  if (random.integer(0, 7) == 0) direction = {0, random.integer(0, 1) ? -0.0f : 0.0f, -1};
  if (direction == Vec3f(0)) direction = {0, 1, 0};
  Ray ray{.origin = targets[random.integer(0, 2)] - distance * direction, .direction = direction};
  if (random.integer(0, 3) == 0) ray.t_max = static_cast<double>(random.unit()) * 2 * distance;
  return ray;
}

void expect_the_bits_of_the_reference(Mesh mesh_value, const BuildSettings& settings = {}) {
  const auto mesh = std::make_shared<const Mesh>(std::move(mesh_value));
  const auto boxes = primitive_boxes(*mesh);
  const StopFlag stop;
  int sets = 0;
  for (const Builder& builder : builders()) {
    Progress progress;
    const BvhTree tree = builder.build(mesh_primitives(*mesh, boxes), settings, progress);
    const Accel binary = make_accel(mesh, tree, *find_layout("binary"), progress);
    RayCaster reference(binary, stop);
    for_each_instruction_set([&](const std::string& name) {
      const Accel wide = make_accel(mesh, tree, *find_layout("wide"), progress);
      ASSERT_TRUE(wide.wide && !binary.wide);
      RayCaster kernel(wide, stop);
      RandomSource random(11);
      int hits = 0;
      for (int i = 0; i < 8000; ++i) {
        const Ray ray = aimed_ray(*mesh, random);
        const Hit expected = reference.closest_hit(ray);
        const Hit hit = kernel.closest_hit(ray);
        ASSERT_EQ(hit.primitive, expected.primitive) << name << ' ' << builder.name << " ray " << i;
        ASSERT_EQ(hit.t, expected.t) << name << ' ' << builder.name << " ray " << i;
        ASSERT_EQ(hit.u, expected.u);
        ASSERT_EQ(hit.v, expected.v);
        ASSERT_EQ(kernel.occluded(ray), expected.is_hit()) << name << " ray " << i;
        hits += hit.is_hit();
      }
      EXPECT_GT(hits, 2000) << name;
      ++sets;
    });
  }
  if (sets == 0) GTEST_SKIP() << "no SIMD kernel for this processor";
}

TEST(Wide, gives_the_bits_of_the_reference_on_a_soup) {
  for (const BuildSettings settings : {BuildSettings{30, 4}, {1, 1}, {64, 1}, {5, 64}}) {
    expect_the_bits_of_the_reference(random_soup(2000, 0.2f, 1), settings);
  }
}

TEST(Wide, gives_the_bits_of_the_reference_on_a_closed_surface) {
  expect_the_bits_of_the_reference(rough_ball(20, 0.1f, 2));
}

TEST(Wide, gives_the_bits_of_the_reference_far_from_the_origin) {
  expect_the_bits_of_the_reference(moved(random_soup(2000, 0.1f, 3), {1e5f, -2e5f, 3e4f}));
}

TEST(Wide, gives_the_bits_of_the_reference_at_any_scale) {
  for (const float scale : {0x1p-120f, 0x1p-44f, 1e-12f, 1e-6f, 1e6f, 1e12f, 1e30f}) {
    expect_the_bits_of_the_reference(scaled(random_soup(1000, 0.1f, 4), scale));
  }
}

TEST(Wide, gives_the_bits_of_the_reference_on_axis_parallel_quads_that_coincide) {
  expect_the_bits_of_the_reference(lattice_quads(1000, 5));
}

TEST(Wide, gives_the_lowest_of_coincident_triangles) {
  expect_the_bits_of_the_reference(repeated(random_soup(20, 1, 6), 30));
}

TEST(Wide, gives_the_bits_of_the_reference_on_a_teapot_in_a_stadium) {
  expect_the_bits_of_the_reference(teapot_in_a_stadium());
}

TEST(Wide, gives_the_bits_of_the_reference_on_denormal_quads_with_long_directions) {
  const float size = 4e-44f;
  Mesh quad = make_test_mesh({{0, 0, 0}, {size, 0, 0}, {size, size, 0}, {0, size, 0}},
                             {{0, 1, 2}, {0, 2, 3}});
  const auto mesh = std::make_shared<const Mesh>(std::move(quad));
  Progress progress;
  const StopFlag stop;
  const BvhTree tree = builders().front().build(primitive_boxes(*mesh), {}, progress);
  const Accel wide = make_accel(mesh, tree, *find_layout("wide"), progress);
  const Accel none = make_accel(mesh, std::nullopt, *find_layout("wide"), progress);
  RayCaster kernel(wide, stop);
  RayCaster brute_force(none, stop);
  RandomSource random(5);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3f target = size * random.vector(-0.2f, 1.2f);
    const Vec3f direction = random.vector(-1, 1);
    const Ray ray{.origin = target - size * direction, .direction = direction};
    const Hit expected = brute_force.closest_hit(ray);
    ASSERT_EQ(kernel.closest_hit(ray).primitive, expected.primitive) << i;
    hits += expected.is_hit();
  }
  EXPECT_GT(hits, 100);
}

TEST(Wide, counting_kernels_answer_alike_and_count_what_they_do) {
  const auto mesh = std::make_shared<const Mesh>(rough_ball(20, 0.1f, 2));
  Progress progress;
  const StopFlag stop;
  const BvhTree tree = builders().front().build(primitive_boxes(*mesh), {}, progress);
  for_each_instruction_set([&](const std::string& name) {
    const Accel accel = make_accel(mesh, tree, *find_layout("wide"), progress);
    VisitCounts counts;
    RandomSource random(3);
    uint64_t hits = 0;
    for (int i = 0; i < 1000; ++i) {
      const Ray ray = aimed_ray(*mesh, random);
      Hit hit, counted, any;
      ASSERT_TRUE(closest_hit_wide(*accel.wide, ray, stop, hit));
      ASSERT_TRUE(closest_hit_wide(*accel.wide, ray, stop, counted, counts));
      ASSERT_EQ(counted.primitive, hit.primitive) << name;
      ASSERT_TRUE(occluded_wide(*accel.wide, ray, stop, any, counts));
      ASSERT_EQ(any.is_hit(), hit.is_hit()) << name;
      hits += hit.is_hit();
    }
    EXPECT_GE(counts.nodes, 2000u) << "the root for each query";
    EXPECT_GE(counts.exact_tests, hits) << "the closest hit is always decided exactly";
    EXPECT_LE(counts.exact_tests, counts.triangles);
    EXPECT_LE(counts.triangles, counts.blocks * static_cast<uint64_t>(accel.wide->width));
  });
}

TEST(Wide, rays_from_far_away_need_hardly_more_exact_tests_than_those_from_near) {
  const auto mesh = std::make_shared<const Mesh>(rough_ball(60, 0.1f, 2));
  Progress progress;
  const StopFlag stop;
  const BvhTree tree = builders().front().build(primitive_boxes(*mesh), {}, progress);
  for_each_instruction_set([&](const std::string& name) {
    const Accel accel = make_accel(mesh, tree, *find_layout("wide"), progress);
    const auto exact_tests_from = [&](float distance) {
      RandomSource random(4);
      VisitCounts counts;
      for (int i = 0; i < 2000; ++i) {
        const Vec3f origin = distance * glm::normalize(random.vector(-1, 1));
        const Ray ray{.origin = origin, .direction = 0.5f * random.vector(-1, 1) - origin};
        Hit hit;
        EXPECT_TRUE(closest_hit_wide(*accel.wide, ray, stop, hit, counts));
      }
      return static_cast<double>(counts.exact_tests);
    };
    const double near = exact_tests_from(3);
    EXPECT_LT(exact_tests_from(1e4f), 1.2 * near) << name;
    EXPECT_LT(exact_tests_from(5e5f), 1.2 * near) << name;
  });
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
constexpr int large_ball_cells = 100;
#else
constexpr int large_ball_cells = 290;  // a million triangles
#endif

TEST(Wide, all_that_is_held_takes_at_most_64_bytes_a_triangle_in_16_lanes) {
  const auto mesh = std::make_shared<const Mesh>(rough_ball(large_ball_cells, 0.1f, 2));
  Progress progress;
  const BvhTree tree = builders().front().build(primitive_boxes(*mesh), {}, progress);
  for_each_instruction_set([&](const std::string& name) {
    const Accel accel = make_accel(mesh, tree, *find_layout("wide"), progress);
    ASSERT_TRUE(accel.wide);
    // Narrow blocks are filled less well.
    const size_t most = accel.wide->width == 16 ? 64 : 76;
    EXPECT_LE(accel.bytes(), most * mesh->triangle_count()) << name;
  });
}

TEST(Wide, the_binary_tree_is_held_only_where_rays_are_traced_through_it) {
  const auto mesh = std::make_shared<const Mesh>(rough_ball(10, 0, 1));
  for (const Layout& layout : layouts()) {
    Progress progress;
    auto tree = std::make_shared<const BvhTree>(
        builders().front().build(primitive_boxes(*mesh), {}, progress));
    const std::weak_ptr<const BvhTree> observed = tree;
    const Accel accel = make_accel(mesh, std::move(tree), layout, progress);
    EXPECT_TRUE(accel.has_tree());
    EXPECT_EQ(observed.expired(), accel.wide != nullptr) << layout.name;
    EXPECT_EQ(accel.bytes(), accel.wide ? accel.wide->bytes() : observed.lock()->bytes());
  }
  EXPECT_FALSE(Accel{mesh}.has_tree());
}

TEST(Wide, a_stopped_layout_is_cancelled) {
  const auto mesh = std::make_shared<const Mesh>(rough_ball(40, 0, 1));
  Progress progress;
  const BvhTree tree = builders().front().build(primitive_boxes(*mesh), {}, progress);
  progress.request_stop();
  EXPECT_THROW(make_accel(mesh, tree, *find_layout("wide"), progress), Cancelled);
}

TEST(Wide, gives_the_bits_of_the_reference_on_one_triangle) {
  expect_the_bits_of_the_reference(random_soup(1, 1, 7));
}

}  // namespace
}  // namespace tracer
