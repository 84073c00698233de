// SPDX-License-Identifier: MIT
#include "tracer/bvh/trace/wide_scalar.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/support/instruction_sets.h"
#include "tests/support/random_source.h"
#include "tests/support/test_meshes.h"
#include "tracer/bvh/build.h"
#include "tracer/bvh/trace/recursive.h"
#include "tracer/bvh/trace/wide_kernels.h"
#include "tracer/geometry/triangle.h"

namespace tracer {
namespace {

Ray random_ray(const Mesh& mesh, RandomSource& random) {
  const auto reach = static_cast<float>(max_abs(mesh.bounds.extent()));
  const Vec3f origin = mesh.bounds.center() + reach * random.vector(-1, 1);
  Ray ray{.origin = origin, .direction = mesh.bounds.center() - origin};
  ray.direction += 0.3f * reach * random.vector(-1, 1);
  if (random.integer(0, 3) == 0) ray.t_max = static_cast<double>(random.unit());
  if (random.integer(0, 3) == 0) ray.t_min = static_cast<double>(random.unit());
  return ray;
}

TEST(WideScalar, gives_the_bits_of_the_reference_and_meets_few_triangles) {
  const Mesh mesh = rough_ball(40, 0.1f, 1);
  uint64_t tests = 0;
  const auto intersect = [&](uint32_t primitive, const Ray& ray) {
    ++tests;
    const Vec3u& index = mesh.triangles[primitive];
    const auto hit = intersect_triangle(ray, mesh.positions[index.x], mesh.positions[index.y],
                                        mesh.positions[index.z]);
    return hit ? Hit{hit->t, hit->u, hit->v, primitive} : Hit{};
  };
  Progress progress;
  const BvhTree tree = builders().front().build(primitive_boxes(mesh), {}, progress);
  for_each_instruction_set([&](const std::string& name) {
    const WideTree wide = build_wide_tree(tree, mesh, wide_kernel_width(), progress);
    RandomSource random(2);
    uint64_t hits = 0;
    tests = 0;
    constexpr uint64_t ray_count = 2000;
    for (uint64_t i = 0; i < ray_count; ++i) {
      const Ray ray = random_ray(mesh, random);
      const Hit hit = closest_hit_scalar(wide, ray, intersect);
      const bool is_occluded = occluded_scalar(wide, ray, intersect);
      const uint64_t tests_so_far = tests;
      const Hit expected = closest_hit_recursive(tree, ray, intersect);
      tests = tests_so_far;
      ASSERT_EQ(hit.primitive, expected.primitive) << name << " ray " << i;
      ASSERT_EQ(hit.t, expected.t) << name << " ray " << i;
      ASSERT_EQ(is_occluded, expected.is_hit()) << name << " ray " << i;
      hits += hit.is_hit();
    }
    EXPECT_GT(hits, ray_count / 4);
    EXPECT_LT(tests / ray_count, mesh.triangle_count() / 100) << name;
  });
}

}  // namespace
}  // namespace tracer
