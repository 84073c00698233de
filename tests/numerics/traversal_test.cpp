// SPDX-License-Identifier: MIT
// Rays in the production path: every layout and instruction set, alone, in bundles and streams.
#include <gtest/gtest.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "tests/numerics/rays.h"
#include "tests/numerics/stress.h"
#include "tests/numerics/ways.h"
#include "tests/support/large_meshes.h"
#include "tests/support/test_meshes.h"

namespace tracer::stress {
namespace {

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

Mesh scaled(Mesh mesh, float factor) {
  for (Vec3f& position : mesh.positions) position *= factor;
  return make_test_mesh(std::move(mesh.positions), std::move(mesh.triangles));
}

Mesh flattened(Mesh mesh) {
  for (Vec3f& position : mesh.positions) position.y *= 1e-6f;
  return make_test_mesh(std::move(mesh.positions), std::move(mesh.triangles));
}

std::vector<NamedMesh> meshes() {
  return {
      {"a soup", random_soup(300, 0.2f, 1)},
      {"a closed surface", rough_ball(5, 0.1f, 2)},
      {"duplicates", repeated(random_soup(30, 0.5f, 3), 10)},
      {"axis-parallel quads", lattice_quads(150, 4)},
      {"slivers", flattened(random_soup(300, 0.3f, 5))},
      {"hair", hair(300, 6)},
      {"a ball in a stadium", stadium(5)},
      {"a soup at 1e5", moved(random_soup(300, 0.2f, 7), {1e5f, -2e5f, 3e4f})},
      {"a soup of 1e-6", scaled(random_soup(300, 0.2f, 8), 1e-6f)},
      {"a soup of 1e30", scaled(random_soup(300, 0.2f, 9), 1e30f)},
      {"a denormal soup", scaled(random_soup(300, 0.2f, 10), 1e-39f)},
  };
}

/// Rays in groups, and what every triangle in turn says about them.
struct JudgedRays {
  std::vector<Ray> rays;
  std::vector<Hit> hits;

  std::span<const Ray> rays_of(uint64_t group) const {
    return std::span(rays).subspan(group * rays_a_group, rays_a_group);
  }
  std::span<const Hit> hits_of(uint64_t group) const {
    return std::span(hits).subspan(group * rays_a_group, rays_a_group);
  }
};

JudgedRays judged_rays(const std::shared_ptr<const Mesh>& mesh, uint64_t group_count) {
  JudgedRays judged;
  judged.rays.resize(group_count * rays_a_group);
  judged.hits.resize(judged.rays.size());
  const Accel brute_force{mesh};
  const StopFlag never;
  parallel_for_each_index(0, group_count, [&](size_t group) {
    RandomSource random(21, group);
    const std::vector<Ray> rays = probing_rays(*mesh, group, random);
    RayCaster caster(brute_force, never);
    for (size_t i = 0; i < rays.size(); ++i) {
      judged.rays[group * rays_a_group + i] = rays[i];
      judged.hits[group * rays_a_group + i] = caster.closest_hit(rays[i]);
    }
  });
  return judged;
}

TEST(NumericsTraversal,
     every_tree_layout_and_instruction_set_answers_with_the_bits_of_brute_force) {
  const uint64_t group_count = trials(60, 600);
  for (const auto& [name, mesh_value] : meshes()) {
    const auto mesh = std::make_shared<const Mesh>(mesh_value);
    const JudgedRays judged = judged_rays(mesh, group_count);
    const std::string property = "answers of all builders, layouts and kernels about " + name;
    Tally total;
    for (const Builder& builder : builders()) {
      for (const BuildSettings settings : {BuildSettings{30, 4}, {64, 1}, {3, 64}}) {
        const BvhTree tree = build_tree(builder, *mesh, settings);
        for_each_accel(mesh, tree, [&](const std::string& way, const Accel& accel) {
          const Tally tally = run_trials(property, 21, group_count, [&](Trial& trial) {
            check_answers(trial, accel, judged.rays_of(trial.index), judged.hits_of(trial.index));
          });
          if (tally.failures > 0) ADD_FAILURE() << way << ' ' << builder.name;
          total.add(tally);
        });
      }
    }
    expect_holds(property, total);
  }
}

// A mesh quantised to integers, and rays straight down at whole and half coordinates.
TEST(NumericsTraversal, an_integer_grid_has_no_holes_for_axis_parallel_rays) {
  constexpr int cells = 32;
  RandomSource heights(41);
  std::vector<Vec3f> positions;
  std::vector<Vec3u> triangles;
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) positions.emplace_back(x, heights.integer(0, 3), y);
  }
  for (uint32_t y = 0; y < cells; ++y) {
    for (uint32_t x = 0; x < cells; ++x) {
      const uint32_t corner = y * (cells + 1) + x;
      triangles.emplace_back(corner, corner + 1, corner + cells + 2);
      triangles.emplace_back(corner, corner + cells + 2, corner + cells + 1);
    }
  }
  const auto mesh = std::make_shared<const Mesh>(make_test_mesh(positions, triangles));
  for (const Builder& builder : builders()) {
    const BvhTree tree = build_tree(builder, *mesh);
    for_each_accel(mesh, tree, [&](const std::string& way, const Accel& accel) {
      const std::string property =
          "holes of an integer grid, " + std::string(builder.name) + ", " + way;
      expect_in_all_trials(property, 41, trials(200, 5000), [&](Trial& trial) {
        RandomSource& random = trial.random;
        std::vector<Ray> rays;
        while (rays.size() < rays_a_group) {
          const bool is_up = random.integer(0, 1) == 0;
          const float zero = random.integer(0, 1) == 0 ? 0.0f : -0.0f;
          const Vec3f origin(0.5f * static_cast<float>(random.integer(0, 2 * cells)),
                             is_up ? -1.0f : 5.0f,
                             0.5f * static_cast<float>(random.integer(0, 2 * cells)));
          rays.push_back({.origin = origin, .direction = {zero, is_up ? 1 : -1, zero}});
        }
        check_all_hit(trial, accel, rays);
      });
    });
  }
}

TEST(NumericsTraversal, the_lowest_of_coincident_triangles_is_hit_whatever_the_tree) {
  constexpr uint32_t distinct = 20;
  Mesh base = random_soup(distinct, 0.6f, 51);
  const auto mesh = std::make_shared<const Mesh>(repeated(std::move(base), 100));
  for (const Builder& builder : builders()) {
    const BvhTree tree = build_tree(builder, *mesh);
    for_each_accel(mesh, tree, [&](const std::string& way, const Accel& accel) {
      const std::string property =
          "lowest of coincident triangles, " + std::string(builder.name) + ", " + way;
      expect_in_all_trials(property, 51, trials(20, 1000), [&](Trial& trial) {
        const auto rays = probing_rays(*mesh, trial.index, trial.random);
        const StopFlag never;
        RayCaster caster(accel, never);
        std::vector<Hit> hits(rays.size());
        caster.closest_hits(rays, hits);
        for (size_t i = 0; i < rays.size(); ++i) {
          if (!hits[i].is_hit()) continue;
          trial.check(hits[i].primitive < distinct, [&] { return literal(rays[i]); });
        }
      });
    });
  }
}

TEST(NumericsTraversal, a_hit_at_the_end_of_the_interval_counts_and_beyond_it_does_not) {
  const auto mesh = std::make_shared<const Mesh>(rough_ball(8, 0.1f, 61));
  const BvhTree tree = build_tree(builders().front(), *mesh);
  for_each_accel(mesh, tree, [&](const std::string& way, const Accel& accel) {
    expect_in_all_trials("ends of intervals, " + way, 61, trials(200, 20'000), [&](Trial& trial) {
      const StopFlag never;
      RayCaster caster(accel, never);
      for (Ray ray : probing_rays(*mesh, trial.index, trial.random)) {
        ray.t_min = 0;
        ray.t_max = std::numeric_limits<double>::infinity();
        const Hit hit = caster.closest_hit(ray);
        if (!hit.is_hit() || hit.t == 0) continue;
        const auto say = [&] { return literal(ray); };
        ray.t_max = hit.t;
        trial.check(are_same_bits(caster.closest_hit(ray), hit) && caster.occluded(ray), say);
        ray.t_min = hit.t;
        trial.check(are_same_bits(caster.closest_hit(ray), hit) && caster.occluded(ray), say);
        ray.t_min = 0;
        ray.t_max = std::nextafter(hit.t, 0);
        trial.check(!caster.closest_hit(ray).is_hit() && !caster.occluded(ray), say);
      }
    });
  });
}

TEST(NumericsTraversal, any_hit_is_found_where_a_closest_one_is_for_rays_that_begin_or_end_at_one) {
  const auto mesh = std::make_shared<const Mesh>(rough_ball(8, 0.1f, 62));
  const BvhTree tree = build_tree(builders().front(), *mesh);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for_each_accel(mesh, tree, [&](const std::string& way, const Accel& accel) {
    expect_in_all_trials("rays from and to hits, " + way, 62, trials(200, 20'000),
                         [&](Trial& trial) {
                           const StopFlag never;
                           RayCaster caster(accel, never);
                           std::vector<Ray> rays;
                           for (Ray ray : probing_rays(*mesh, trial.index, trial.random)) {
                             ray.t_min = 0;
                             ray.t_max = infinity;
                             const Hit hit = caster.closest_hit(ray);
                             if (!hit.is_hit()) continue;
                             const Vec3f origin = ray.origin;
                             ray.origin = Vec3f(Vec3d(origin) + hit.t * Vec3d(ray.direction));
                             rays.push_back(ray);  // to either side of the surface, or on it
                             ray.t_min = 1e-60;    // 0 as a float
                             rays.push_back(ray);
                             ray.origin = origin;
                             ray.t_min = std::nextafter(hit.t, infinity);
                             rays.push_back(ray);
                             const double part = trial.random.integer(-40, 40) * 0x1p-24;
                             ray.t_min = 0;
                             ray.t_max = hit.t * (1 + part);
                             rays.push_back(ray);
                           }
                           std::vector<Hit> closest;
                           for (const Ray& ray : rays) closest.push_back(caster.closest_hit(ray));
                           check_answers(trial, accel, rays, closest);
                         });
  });
}

TEST(NumericsTraversal, rays_that_are_not_finite_hit_nothing_and_return) {
  constexpr float bad_values[] = {std::numeric_limits<float>::quiet_NaN(),
                                  std::numeric_limits<float>::infinity(),
                                  -std::numeric_limits<float>::infinity()};
  const auto mesh = std::make_shared<const Mesh>(rough_ball(8, 0.1f, 71));
  const BvhTree tree = build_tree(builders().front(), *mesh);
  for_each_accel(mesh, tree, [&](const std::string& way, const Accel& accel) {
    expect_in_all_trials("rays not finite, " + way, 71, trials(100, 5000), [&](Trial& trial) {
      std::vector<Ray> rays = probing_rays(*mesh, trial.index, trial.random);
      const auto all_alike = static_cast<uint64_t>(trial.random.integer(0, 1));
      for (size_t i = 0; i < rays.size(); ++i) {
        // One bad ray among good ones, and nothing but bad ones.
        if (all_alike == 0 && i % 8 != 3) continue;
        Vec3f& spoilt = trial.random.integer(0, 1) == 0 ? rays[i].origin : rays[i].direction;
        spoilt[trial.random.integer(0, 2)] = bad_values[trial.random.integer(0, 2)];
      }
      const StopFlag never;
      RayCaster caster(accel, never);
      std::vector<Hit> hits(rays.size());
      std::vector<uint8_t> is_occluded(rays.size());
      caster.closest_hits(rays, hits);
      caster.occluded(rays, is_occluded);
      for (size_t i = 0; i < rays.size(); ++i) {
        if (is_finite(rays[i].origin) && is_finite(rays[i].direction)) {
          trial.check(are_same_bits(hits[i], caster.closest_hit(rays[i])) &&
                          (is_occluded[i] != 0) == hits[i].is_hit(),
                      [&] { return "a good ray, " + literal(rays[i]); });
        } else {
          trial.check(!hits[i].is_hit() && is_occluded[i] == 0 &&
                          !caster.closest_hit(rays[i]).is_hit() && !caster.occluded(rays[i]),
                      [&] { return literal(rays[i]); });
        }
      }
    });
  });
}

#if defined(__SSE2__)
/// Denormals are taken and given as 0 on this thread, as some hosts of a library have it.
class FlushToZero {
 public:
  FlushToZero() { _mm_setcsr(before_ | 0x8040); }
  ~FlushToZero() { _mm_setcsr(before_); }
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
  const unsigned before_ = _mm_getcsr();
};

TEST(NumericsTraversal, flushing_denormals_to_zero_changes_no_answer_at_sizes_from_1e_6_to_1e6) {
  const uint64_t group_count = trials(60, 2000);
  for (const float size : {1e-6f, 1.0f, 1e6f}) {
    const auto mesh = std::make_shared<const Mesh>(scaled(rough_ball(5, 0.1f, 81), size));
    const JudgedRays judged = judged_rays(mesh, group_count);
    const BvhTree tree = build_tree(builders().front(), *mesh);
    for_each_accel(mesh, tree, [&](const std::string& way, const Accel& accel) {
      const std::string property =
          "answers with denormals flushed, size " + literal(size) + ", " + way;
      expect_in_all_trials(property, 81, group_count, [&](Trial& trial) {
        const FlushToZero flush;
        check_answers(trial, accel, judged.rays_of(trial.index), judged.hits_of(trial.index));
      });
    });
  }
}
#endif

}  // namespace
}  // namespace tracer::stress
