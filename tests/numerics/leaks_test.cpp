// SPDX-License-Identifier: MIT
// Closed surfaces let nothing through: rays at their vertices and edges, by every way to trace.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/bench/compare/embree_scene.h"
#include "tests/numerics/rays.h"
#include "tests/numerics/stress.h"
#include "tests/numerics/ways.h"
#include "tests/support/test_meshes.h"

namespace tracer::stress {
namespace {

/// At a vertex or the middle of an edge of a lattice_ball, exactly: with an integral origin, all
/// coordinates are integers below 2^24.
Ray exact_ray(const Mesh& ball, const Vec3f& origin, uint32_t triangle, RandomSource& random) {
  const TestTriangle corners = triangle_of(ball, triangle);
  const Vec3f targets[] = {corners.v0, 0.5f * (corners.v1 + corners.v2)};
  return {.origin = origin, .direction = targets[random.integer(0, 1)] - origin};
}

bool hits_in_float(const Mesh& mesh, const Ray& ray) {
  for (uint32_t i = 0; i < mesh.triangle_count(); ++i) {
    if (moeller_trumbore(ray, triangle_of(mesh, i))) return true;
  }
  return false;
}

enum class Aiming { exact, as_floats_can };
enum class Bundling { from_one_point, to_one_point, none };

struct LeakKind {
  const char* name;
  Aiming aiming;
  Bundling bundling;
};
constexpr LeakKind leak_kinds[] = {
    {"from a point inside, exactly aimed", Aiming::exact, Bundling::from_one_point},
    {"from a point inside, aimed as floats can", Aiming::as_floats_can, Bundling::from_one_point},
    {"to a point inside, exactly aimed", Aiming::exact, Bundling::to_one_point},
    {"from anywhere inside, exactly aimed", Aiming::exact, Bundling::none},
    {"from anywhere inside, aimed as floats can", Aiming::as_floats_can, Bundling::none},
};

/// Rays from or to the inside of a closed ball, at its vertices and edges.
std::vector<Ray> rays_at_edges(const Mesh& ball, const LeakKind& kind, RandomSource& random) {
  const auto point_inside = [&] {
    const Vec3f point = 600.0f * random.vector(-1, 1);
    return kind.aiming == Aiming::exact ? glm::round(point) : point;
  };
  std::vector<Ray> rays;
  const uint32_t near = random_triangle(ball, random);
  const Vec3f shared_point = point_inside();
  while (rays.size() < rays_a_group) {
    const bool is_alone = kind.bundling == Bundling::none;
    const Vec3f inside = is_alone ? point_inside() : shared_point;
    const uint32_t reach = static_cast<uint32_t>(random.integer(0, 20));
    const uint32_t triangle =
        is_alone ? random_triangle(ball, random) : (near + reach) % ball.triangle_count();
    Ray ray = exact_ray(ball, inside, triangle, random);
    if (kind.aiming == Aiming::as_floats_can) {
      ray.direction = random_target(ball, triangle, random) - inside;
    }
    if (kind.bundling == Bundling::to_one_point) {
      ray = {
          .origin = inside + 2.0f * ray.direction, .direction = -2.0f * ray.direction, .t_max = 1};
    }
    rays.push_back(ray);
  }
  return rays;
}

TEST(NumericsLeaks, no_ray_leaks_through_a_closed_surface_by_any_kernel) {
  const auto ball = std::make_shared<const Mesh>(lattice_ball(8, 31));
  const BvhTree tree = build_tree(builders().front(), *ball);
  for (const LeakKind& kind : leak_kinds) {
    for_each_accel(ball, tree, [&](const std::string& way, const Accel& accel) {
      // The recursive reference is the slowest, and what it rests on is tested alone.
      const bool is_reference = accel.tree != nullptr;
      const std::string property = std::string("leaks of rays ") + kind.name + ", " + way;
      const uint64_t trials_a_control = is_long() && !is_reference ? 64 : 1;
      const uint64_t count = trials(is_reference ? 200 : 500, is_reference ? 5'000 : 300'000);
      const Tally tally = run_trials(property, 31, count, [&](Trial& trial) {
        const std::vector<Ray> rays = rays_at_edges(*ball, kind, trial.random);
        check_all_hit(trial, accel, rays);
        if (trial.index % trials_a_control != 0) return;
        trial.check_control(hits_in_float(*ball, rays[0]));
        trial.check_control(hits_in_float(*ball, rays[1]));
      });
      expect_holds_and_control_fails(property, tally, 100);
    });
  }
}

#ifdef BOXWOOD_EMBREE
bool hits_in_embree(const bench::EmbreeScene& scene, const Ray& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = bench::make_query(ray);
  rtcIntersect1(scene.scene(), &context, &query);
  return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

// The control is the library itself, asked for the same rays.
TEST(NumericsLeaks, rays_that_embree_loses_are_found) {
  const auto ball = std::make_shared<const Mesh>(lattice_ball(8, 31));
  const BvhTree tree = build_tree(builders().front(), *ball);
  Progress progress;
  const Accel accel = make_accel(ball, tree, layouts().front(), progress);
  for (const bench::EmbreeMode mode : {bench::EmbreeMode::standard, bench::EmbreeMode::robust}) {
    const bool is_robust = mode == bench::EmbreeMode::robust;
    bench::EmbreeScene embree(*ball, RTC_BUILD_QUALITY_MEDIUM, mode);
    embree.build();
    for (const LeakKind& kind : leak_kinds) {
      const std::string property =
          fmt::format("rays {}; control: Embree, {}", kind.name, is_robust ? "ROBUST" : "default");
      const Tally tally = run_trials(property, 34, trials(1'000, 200'000), [&](Trial& trial) {
        const std::vector<Ray> rays = rays_at_edges(*ball, kind, trial.random);
        const StopFlag never;
        RayCaster caster(accel, never);
        for (const Ray& ray : rays) {
          trial.check(caster.closest_hit(ray).is_hit(), [&] { return literal(ray); });
          trial.check_control(hits_in_embree(embree, ray));
        }
      });
      const bool is_hard = !is_robust && kind.aiming == Aiming::as_floats_can;
      expect_holds_and_control_fails(property, tally, is_hard ? 100 : 0);
    }
  }
}
#endif

// Origins and directions are small integers times powers of two: the aim is exact at any distance.
TEST(NumericsLeaks, rays_from_a_million_sizes_away_hit_the_vertex_they_aim_at) {
  Mesh mesh = rough_ball(2, 0.05f, 33);
  for (Vec3f& position : mesh.positions) position = 2.0f * glm::round(4.0f * position);
  const auto ball = std::make_shared<const Mesh>(make_test_mesh(mesh.positions, mesh.triangles));
  const BvhTree tree = build_tree(builders().front(), *ball);
  for_each_accel(ball, tree, [&](const std::string& way, const Accel& accel) {
    const std::string property = "hits from 1e6 sizes away, " + way;
    expect_in_all_trials(property, 33, trials(500, 30'000), [&](Trial& trial) {
      RandomSource& random = trial.random;
      std::vector<Ray> rays;
      while (rays.size() < rays_a_group) {
        const Vec3f direction = random.lattice(-15, 15);
        if (direction == Vec3f(0)) continue;
        const Ray aim = exact_ray(*ball, Vec3f(0), random_triangle(*ball, random), random);
        const float steps = std::exp2(static_cast<float>(random.integer(0, 19)));
        rays.push_back({.origin = aim.direction - steps * direction, .direction = direction});
      }
      check_all_hit(trial, accel, rays);
    });
  });
}

}  // namespace
}  // namespace tracer::stress
