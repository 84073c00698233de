// SPDX-License-Identifier: MIT
// What users of other ray tracers have reported of them: issues 387, 416 and 423 of Embree.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/numerics/rays.h"
#include "tests/numerics/stress.h"
#include "tests/numerics/ways.h"
#include "tests/support/exact_hit.h"
#include "tests/support/test_meshes.h"
#include "tracer/geometry/triangle.h"

namespace tracer::stress {
namespace {

/// The nearest of all hits in the ray's interval, by integers; no_primitive where there is none.

struct NearestExactHit {
  long double t = 0;
  uint32_t primitive = no_primitive;
};

NearestExactHit nearest_exact_hit(const Mesh& mesh, const Ray& ray) {
  NearestExactHit nearest;
  for (uint32_t i = 0; i < mesh.triangle_count(); ++i) {
    const TestTriangle t = triangle_of(mesh, i);
    const ExactHit hit = exact_hit(ray, t.v0, t.v1, t.v2);
    if (!hit.is_hit || hit.t < ray.t_min || hit.t > ray.t_max) continue;
    if (nearest.primitive == no_primitive || hit.t < nearest.t) nearest = {hit.t, i};
  }
  return nearest;
}

bool agree(const Hit& hit, const NearestExactHit& exact) {
  if (!hit.is_hit() || exact.primitive == no_primitive) {
    return !hit.is_hit() && exact.primitive == no_primitive;
  }
  return std::abs(hit.t - exact.t) <= 0x1p-32L * exact.t;
}

/// Compares all ways with brute force, and that with integers.
void check_with_integers(Trial& trial, const std::shared_ptr<const Mesh>& mesh, const Accel& accel,
                         std::span<const Ray> rays) {
  const StopFlag never;
  const Accel brute_force{mesh};
  RayCaster caster(brute_force, never);
  std::vector<Hit> hits;
  for (const Ray& ray : rays) {
    hits.push_back(caster.closest_hit(ray));
    trial.check(agree(hits.back(), nearest_exact_hit(*mesh, ray)),
                [&] { return literal(ray) + " gives " + literal(hits.back()); });
  }
  check_answers(trial, accel, rays, hits);
}

/// Longer than it is wide by up to 50 times, hundreds of units from the origin.
TestTriangle skinny_triangle(RandomSource& random) {
  const Vec3f corner = 300.0f * random.vector(-1, 1);
  const Vec3f side = 10.0f * random.vector(-1, 1);
  return {corner, corner + side,
          corner + 0.8f * side + random.between(0.1f, 1) * random.vector(-1, 1)};
}

/// Almost in the plane, from up to 60 lengths away, at what lies in the plane around.
Ray grazing_segment(const TestTriangle& triangle, RandomSource& random) {
  const auto in_plane = [&] {
    return random.between(-1, 2) * (triangle.v1 - triangle.v0) +
           random.between(-3, 3) * (triangle.v2 - triangle.v0);
  };
  const Vec3f target = triangle.v0 + in_plane();
  const Vec3f away = random.between(1, 20) * in_plane() + 0.5f * random.vector(-1, 1);
  const float reach = random.between(0.5f, 2);  // beyond the target, or short of it
  return {.origin = target + away, .direction = -reach * away, .t_max = 1};
}

// The control hits, at distances of no meaning, triangles that the ray passes by.
TEST(NumericsReported, segments_almost_in_the_plane_of_skinny_triangles_hit_where_integers_say) {
  const std::string property = "segments almost in the plane of skinny triangles";
  const Tally tally = run_trials(property, 1, trials(50'000, 10'000'000), [](Trial& trial) {
    const TestTriangle triangle = skinny_triangle(trial.random);
    const Ray ray = grazing_segment(triangle, trial.random);
    const ExactHit exact = exact_hit(ray, triangle.v0, triangle.v1, triangle.v2);
    const bool is_hit = exact.is_hit && exact.t >= 0 && exact.t <= 1;
    const auto hit = intersect_triangle(ray, triangle.v0, triangle.v1, triangle.v2);
    trial.check(
        hit.has_value() == is_hit && (!hit || std::abs(hit->t - exact.t) <= 0x1p-32L * exact.t),
        [&] { return literal(ray) + ", " + literal(triangle); });
    const auto in_float = pluecker(ray, triangle);
    trial.check_control((in_float && *in_float <= 1) == is_hit);
  });
  expect_holds_and_control_fails(property, tally, 100);
}

TEST(NumericsReported, segments_through_many_skinny_triangles_meet_the_same_by_all_kernels) {
  RandomSource random(2);
  std::vector<Vec3f> positions;
  std::vector<Vec3u> triangles;
  for (uint32_t i = 0; i < 100; ++i) {
    const TestTriangle t = skinny_triangle(random);
    positions.insert(positions.end(), {t.v0, t.v1, t.v2});
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  const auto mesh = std::make_shared<const Mesh>(make_test_mesh(positions, triangles));
  const BvhTree tree = build_tree(builders().front(), *mesh);
  for_each_accel(mesh, tree, [&](const std::string& way, const Accel& accel) {
    expect_in_all_trials(
        "segments through skinny triangles, " + way, 2, trials(20, 2'000), [&](Trial& trial) {
          std::vector<Ray> rays;
          while (rays.size() < rays_a_group) {
            const uint32_t triangle = random_triangle(*mesh, trial.random);
            rays.push_back(grazing_segment(triangle_of(*mesh, triangle), trial.random));
          }
          check_with_integers(trial, mesh, accel, rays);
        });
  });
}

/// 12 triangles, as wide as `half_width` on either side and 120,000 high.
Mesh flat_box(float half_width) {
  constexpr float height = 120'000;
  std::vector<Vec3f> corners;
  for (uint32_t i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? half_width : -half_width, i & 2 ? half_width : -half_width,
                         i & 4 ? height : 0);
  }
  const Vec3u faces[][2] = {{{0, 1, 3}, {0, 3, 2}}, {{4, 5, 7}, {4, 7, 6}}, {{0, 1, 5}, {0, 5, 4}},
                            {{2, 3, 7}, {2, 7, 6}}, {{0, 2, 6}, {0, 6, 4}}, {{1, 3, 7}, {1, 7, 5}}};
  std::vector<Vec3u> triangles;
  for (const auto& face : faces) triangles.insert(triangles.end(), {face[0], face[1]});
  return make_test_mesh(std::move(corners), std::move(triangles));
}

TEST(NumericsReported, a_box_up_to_ten_million_times_wider_than_high_is_hit_where_integers_say) {
  for (const float half_width : {1e5f, 5.890750e8f, 5.890750e11f, 1e12f}) {
    const auto mesh = std::make_shared<const Mesh>(flat_box(half_width));
    const BvhTree tree = build_tree(builders().front(), *mesh, {.leaf_size = 1});
    for_each_accel(mesh, tree, [&](const std::string& way, const Accel& accel) {
      const std::string property = fmt::format("rays at a box {:g} wide, {}", 2 * half_width, way);
      expect_in_all_trials(property, 3, trials(20, 2'000), [&](Trial& trial) {
        RandomSource& random = trial.random;
        std::vector<Ray> rays;
        while (rays.size() < rays_a_group) {
          const float where = half_width * std::exp2(random.between(-30, 0));
          const Vec3f origin(where * random.vector(-1, 1).x, where * random.vector(-1, 1).y,
                             random.integer(0, 1) == 0 ? 120'500.0f : random.between(0, 120'000));
          Vec3f direction(0, 0, -1);
          if (random.integer(0, 1) == 0) {
            direction = random.vector(-1, 1);
            direction.z *= std::exp2(random.between(-30, 0));
          }
          rays.push_back({.origin = origin, .direction = direction});
        }
        check_with_integers(trial, mesh, accel, rays);
      });
    });
  }
}

}  // namespace
}  // namespace tracer::stress
