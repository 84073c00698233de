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
#include "tracer/bvh/trace/bundle_kernels.h"

namespace tracer {
namespace {

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

Mesh scaled(Mesh mesh, float factor) {
  for (Vec3f& position : mesh.positions) position *= factor;
  return make_test_mesh(mesh.positions, mesh.triangles);
}

std::vector<NamedMesh> meshes() {
  std::vector<NamedMesh> all{
      {"soup", random_soup(2000, 0.2f, 1)},
      {"one triangle", random_soup(1, 1, 7)},
      {"closed surface", rough_ball(20, 0.1f, 2)},
      {"far away", moved(random_soup(1000, 0.1f, 3), {1e5f, -2e5f, 3e4f})},
      {"lattice", lattice_quads(500, 5)},
      {"coincident", repeated(random_soup(20, 1, 6), 30)},
      {"slivers", random_soup(500, 0.3f, 8)},
  };
  for (Vec3f& position : all.back().mesh.positions) position.y = 1e-6f * position.y;
  for (const float scale : {0x1p-120f, 1e-12f, 1e-6f, 1e6f, 1e12f, 1e30f}) {
    all.push_back({"scale " + std::to_string(scale), scaled(random_soup(500, 0.2f, 4), scale)});
  }
  return all;
}

Accel accel_of(const Mesh& mesh, const char* layout) {
  Progress progress;
  auto shared = std::make_shared<const Mesh>(mesh);
  BvhTree tree = builders().front().build(primitive_boxes(*shared), {}, progress);
  return make_accel(shared, std::move(tree), *find_layout(layout), progress);
}

Vec3f random_vertex(const Mesh& mesh, RandomSource& random) {
  const auto last = static_cast<int>(mesh.triangle_count()) - 1;
  const Vec3u& triangle = mesh.triangles[static_cast<size_t>(random.integer(0, last))];
  return mesh.positions[triangle[random.integer(0, 2)]];
}

float size_of(const Mesh& mesh) {
  const Vec3d extent = mesh.bounds.extent();
  return static_cast<float>(std::max({extent.x, extent.y, extent.z}));
}

/// From one point, in or on or outside the mesh, to a window around a vertex; some of its rays aim
/// at vertices exactly, some are short, some start late.
std::vector<Ray> rays_from_a_point(const Mesh& mesh, size_t count, RandomSource& random) {
  const float size = size_of(mesh);
  const Vec3f target = random_vertex(mesh, random);
  const float distances[] = {0, 0.1f, 1, 10};
  Vec3f away = random.vector(-1, 1);
  if (random.integer(0, 2) == 0) away = {0, random.integer(0, 1) ? 1.0f : -1.0f, 0};
  const Vec3f origin = target + size * distances[random.integer(0, 3)] * away;
  const Vec3f forward = target == origin ? away * size : target - origin;
  const float widths[] = {0, 1e-4f, 0.01f, 0.1f, 1};
  const float width = widths[random.integer(0, 4)] * static_cast<float>(max_abs(Vec3d(forward)));
  std::vector<Ray> rays(count);
  for (Ray& ray : rays) {
    ray = {.origin = origin, .direction = forward + width * random.vector(-1, 1)};
    if (random.integer(0, 7) == 0) ray.direction = random_vertex(mesh, random) - origin;
    if (ray.direction == Vec3f(0)) ray.direction = forward;
    if (random.integer(0, 7) == 0) ray.t_max = 2 * static_cast<double>(random.unit());
    if (random.integer(0, 7) == 0) ray.t_min = static_cast<double>(random.unit());
  }
  return rays;
}

/// The same, reversed: they end in the point at t = 1, as nearly as floats can.
std::vector<Ray> rays_to_a_point(const Mesh& mesh, size_t count, RandomSource& random) {
  std::vector<Ray> rays = rays_from_a_point(mesh, count, random);
  const Vec3f light = rays.front().origin;
  for (Ray& ray : rays) {
    ray.origin = light + ray.direction * (0.1f + random.unit());
    if (random.integer(0, 7) == 0) ray.origin = random_vertex(mesh, random);
    ray.direction = light - ray.origin;
    if (ray.direction == Vec3f(0)) ray.direction = {0, 0, 1};
    ray.t_min = random.integer(0, 7) == 0 ? static_cast<double>(random.unit()) : 0;
    ray.t_max = 1;
  }
  return rays;
}

void expect_same_bits(const Hit& hit, const Hit& expected) {
  ASSERT_EQ(hit.primitive, expected.primitive);
  ASSERT_EQ(hit.t, expected.t);
  ASSERT_EQ(hit.u, expected.u);
  ASSERT_EQ(hit.v, expected.v);
}

constexpr size_t ray_counts[] = {1, 3, 8, 17, 63, 64, 65, 200};

/// Calls f(mesh, caster, reference) for every mesh and instruction set.
template <class F>
void for_each_caster(F&& f) {
  const StopFlag stop;
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const Accel binary = accel_of(mesh, "binary");
    RayCaster reference(binary, stop);
    for_each_instruction_set([&, &mesh = mesh](const std::string& set) {
      SCOPED_TRACE(set);
      const Accel wide = accel_of(mesh, "wide");
      RayCaster caster(wide, stop);
      f(mesh, caster, reference);
    });
  }
}

TEST(Bundle, rays_from_a_point_give_the_bits_of_the_reference) {
  for_each_caster([](const Mesh& mesh, RayCaster& caster, RayCaster& reference) {
    RandomSource random(11);
    for (int i = 0; i < 400; ++i) {
      const auto rays = rays_from_a_point(mesh, ray_counts[static_cast<size_t>(i) % 8], random);
      std::vector<Hit> hits(rays.size());
      caster.closest_hits(rays, hits);
      for (size_t k = 0; k < rays.size(); ++k) {
        SCOPED_TRACE(k);
        ASSERT_NO_FATAL_FAILURE(expect_same_bits(hits[k], reference.closest_hit(rays[k])));
      }
    }
  });
}

TEST(Bundle, rays_to_a_point_give_the_verdicts_of_the_reference) {
  for_each_caster([](const Mesh& mesh, RayCaster& caster, RayCaster& reference) {
    RandomSource random(12);
    for (int i = 0; i < 400; ++i) {
      const auto rays = rays_to_a_point(mesh, ray_counts[static_cast<size_t>(i) % 8], random);
      std::vector<uint8_t> is_occluded(rays.size());
      caster.occluded(rays, is_occluded);
      for (size_t k = 0; k < rays.size(); ++k) {
        ASSERT_EQ(is_occluded[k] != 0, reference.occluded(rays[k])) << k;
      }
    }
  });
}

// Else the two tests above would hold if no bundle were ever traced.
TEST(Bundle, rays_of_a_square_of_pixels_are_one_bundle) {
  const Accel accel = accel_of(rough_ball(20, 0.1f, 2), "wide");
  if (!accel.wide) GTEST_SKIP() << "no SIMD kernel for this processor";
  std::vector<Ray> rays, shadow_rays;
  for (int i = 0; i < 64; ++i) {
    const Vec3f direction(0.01f * static_cast<float>(i % 8), 0.01f * static_cast<float>(i / 8), -1);
    rays.push_back({.origin = {0, 0, 3}, .direction = direction});
    shadow_rays.push_back(
        {.origin = Vec3f(0, 0, 3) + 2.0f * direction, .direction = -2.0f * direction, .t_max = 1});
  }
  const StopFlag stop;
  std::vector<Hit> hits(64);
  std::vector<uint8_t> is_occluded(64);
  for_each_instruction_set([&](const std::string& set) {
    const Accel wide = accel_of(rough_ball(20, 0.1f, 2), "wide");
    EXPECT_EQ(closest_hits_bundles(*wide.wide, rays, 1, stop, hits).answered, 1u) << set;
    EXPECT_EQ(occluded_bundles(*wide.wide, shadow_rays, 1, stop, is_occluded).answered, 1u) << set;
  });
}

TEST(Bundle, rays_from_different_points_are_no_bundle) {
  const Accel accel = accel_of(rough_ball(5, 0, 2), "wide");
  if (!accel.wide) GTEST_SKIP() << "no SIMD kernel for this processor";
  std::vector<Ray> rays(16, Ray{.origin = {0, 0, 3}, .direction = {0, 0, -1}, .t_max = 1});
  rays[7].origin.x = 1e-3f;
  const StopFlag stop;
  std::vector<Hit> hits(16);
  std::vector<uint8_t> is_occluded(16);
  EXPECT_EQ(closest_hits_bundles(*accel.wide, rays, 1, stop, hits).answered, 0u);
  EXPECT_EQ(occluded_bundles(*accel.wide, rays, 1, stop, is_occluded).answered, 0u);
}

/// Rays without anything in common, among them some that kernels leave to others.
std::vector<Ray> rays_of_all_kinds(const Mesh& mesh, size_t count, RandomSource& random) {
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const bool ends = random.integer(0, 1) == 0;
    rays.push_back(ends ? rays_to_a_point(mesh, 1, random)[0]
                        : rays_from_a_point(mesh, 1, random)[0]);
    if (random.integer(0, 99) == 0) rays.back().direction *= 0x1p100f;
  }
  return rays;
}

TEST(Stream, any_rays_give_the_bits_of_the_reference) {
  for_each_caster([](const Mesh& mesh, RayCaster& caster, RayCaster& reference) {
    RandomSource random(13);
    for (const size_t count : {1, 7, 8, 31, 33, 500}) {
      const auto rays = rays_of_all_kinds(mesh, count, random);
      std::vector<Hit> hits(count);
      caster.closest_hits(rays, hits);
      for (size_t k = 0; k < count; ++k) {
        SCOPED_TRACE(k);
        ASSERT_NO_FATAL_FAILURE(expect_same_bits(hits[k], reference.closest_hit(rays[k])));
      }
    }
  });
}

TEST(Stream, any_rays_give_the_verdicts_of_the_reference) {
  for_each_caster([](const Mesh& mesh, RayCaster& caster, RayCaster& reference) {
    RandomSource random(15);
    for (const size_t count : {1, 7, 8, 31, 33, 500}) {
      const auto rays = rays_of_all_kinds(mesh, count, random);
      std::vector<uint8_t> is_occluded(count);
      caster.occluded(rays, is_occluded);
      for (size_t k = 0; k < count; ++k) {
        ASSERT_EQ(is_occluded[k] != 0, reference.occluded(rays[k])) << k;
      }
    }
  });
}

// Else the two tests above would hold if no stream were ever traced.
TEST(Stream, answers_all_rays_in_range_and_none_from_the_first_that_is_not) {
  const Mesh mesh = random_soup(2000, 0.2f, 1);
  const StopFlag stop;
  for_each_instruction_set([&](const std::string& set) {
    SCOPED_TRACE(set);
    const Accel accel = accel_of(mesh, "wide");
    RandomSource random(16);
    std::vector<Ray> rays;
    while (rays.size() < 100) rays.push_back(rays_from_a_point(mesh, 1, random)[0]);
    std::vector<Hit> hits(rays.size());
    std::vector<uint8_t> is_occluded(rays.size());
    EXPECT_EQ(closest_hits_stream(*accel.wide, rays, stop, hits), 100u);
    EXPECT_EQ(occluded_stream(*accel.wide, rays, stop, is_occluded), 100u);
    for (const size_t out : {0, 1, 40, 99}) {
      auto some = rays;
      some[out].direction *= 0x1p100f;
      EXPECT_EQ(closest_hits_stream(*accel.wide, some, stop, hits), out);
      EXPECT_EQ(occluded_stream(*accel.wide, some, stop, is_occluded), out);
    }
  });
}

TEST(Bundle, every_ray_is_counted_once) {
  const StopFlag stop;
  const Mesh mesh = rough_ball(10, 0, 2);
  for (const char* layout : {"wide", "binary"}) {
    const Accel accel = accel_of(mesh, layout);
    RayCaster caster(accel, stop);
    RandomSource random(14);
    const auto rays = rays_to_a_point(mesh, 1000, random);
    std::vector<Hit> hits(rays.size());
    std::vector<uint8_t> is_occluded(rays.size());
    caster.closest_hits(rays, hits);
    EXPECT_EQ(caster.ray_count(), 1000u);
    caster.occluded(rays, is_occluded);
    EXPECT_EQ(caster.ray_count(), 2000u);
  }
}

TEST(Bundle, a_stopped_caster_answers_at_once) {
  const Accel accel = accel_of(rough_ball(20, 0, 2), "wide");
  StopFlag stop;
  stop.request();
  RayCaster caster(accel, stop);
  std::vector<Ray> rays(500, Ray{.origin = {0, 0, 3}, .direction = {0, 0, -1}});
  std::vector<Hit> hits(rays.size());
  caster.closest_hits(rays, hits);
  EXPECT_FALSE(hits[0].is_hit());
}

}  // namespace
}  // namespace tracer
