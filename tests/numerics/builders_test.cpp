// SPDX-License-Identifier: MIT
// Builders on input that breaks builders: the right answers, bounded depth, and in good time.
#include <atomic>
#include <cmath>
#include <ctime>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/numerics/hard_inputs.h"
#include "tests/numerics/stress.h"
#include "tests/numerics/ways.h"
#include "tests/support/test_meshes.h"
#include "tracer/bvh/build/reinsertion.h"
#include "tracer/obj/make_mesh.h"
#include "tracer/obj/parse_obj.h"

namespace tracer::stress {
namespace {

/// Finite rays at vertices and insides, from near.
std::vector<Ray> rays_at(const Mesh& mesh, size_t count) {
  RandomSource random(2);
  std::vector<Ray> rays;
  for (int attempt = 0; rays.size() < count && attempt < 10'000; ++attempt) {
    const TestTriangle t = triangle_of(mesh, random_triangle(mesh, random));
    const Vec3f target = 0.5f * t.v0 + 0.25f * t.v1 + 0.25f * t.v2;
    const Vec3f origin = 0.5f * target + 0.25f * mesh.bounds.max * random.unit();
    const Vec3f direction = random.integer(0, 3) == 0 ? Vec3f(0, 0, -1) : target - origin;
    if (direction == Vec3f(0) || !is_finite(direction)) continue;
    rays.push_back({.origin = origin, .direction = direction});
  }
  return rays;
}

std::vector<Hit> brute_force_hits(const std::shared_ptr<const Mesh>& mesh,
                                  const std::vector<Ray>& rays) {
  const Accel brute_force{mesh};
  std::vector<Hit> hits(rays.size());
  parallel_for_each_index(0, rays.size(), [&](size_t i) {
    const StopFlag never;
    hits[i] = RayCaster(brute_force, never).closest_hit(rays[i]);
  });
  return hits;
}

/// On two processors: what they spend, so that whatever else the machine does is not counted.
double seconds_to_build(const Builder& builder, const Mesh& mesh, const BuildSettings& settings) {
  const std::clock_t start = std::clock();
  build_tree(builder, mesh, settings);
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / 2;
}

constexpr BuildSettings settings_tried[] = {{}, {64, 1}, {7, 4}};

TEST(NumericsBuilders, any_input_gives_a_valid_tree_of_bounded_depth) {
  for (const Input& input : inputs()) {
    const auto mesh = make_input(input, static_cast<uint32_t>(trials(20'000, 100'000)));
    const auto boxes = primitive_boxes(*mesh);
    Tally tally;
    Trial trial(1, 0, tally);
    for (const Builder& builder : builders()) {
      for (const BuildSettings& settings : settings_tried) {
        const std::string fault = validate(build_tree(builder, *mesh, settings),
                                           mesh_primitives(*mesh, boxes), settings.max_depth);
        trial.check(fault.empty(), [&] { return fmt::format("{}: {}", builder.name, fault); });
      }
    }
    expect_holds(std::string("trees over ") + input.name, tally);
  }
}

TEST(NumericsBuilders, a_round_of_reinsertion_of_any_tree_ends_and_leaves_it_valid) {
  for (const Input& input : inputs()) {
    const auto mesh = make_input(input, static_cast<uint32_t>(trials(2'000, 20'000)));
    const auto boxes = primitive_boxes(*mesh);
    Tally tally;
    Trial trial(1, 0, tally);
    for (const Builder& builder : builders()) {
      const BvhTree tree = build_tree(builder, *mesh);
      Progress progress;
      const auto start = std::chrono::steady_clock::now();
      const BvhTree better = reinsert(tree, {}, progress);
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
      trial.measure(time.count() * 1e6 / std::max<size_t>(1, tree.nodes.size()));
      const std::string fault = validate(better, mesh_primitives(*mesh, boxes), 30);
      trial.check(fault.empty(), [&] { return fmt::format("{}: {}", builder.name, fault); });
    }
    expect_holds(fmt::format("reinserted trees over {} (worst: us a node)", input.name), tally);
  }
}

TEST(NumericsBuilders, any_input_is_answered_as_by_brute_force) {
  for (const Input& input : inputs()) {
    const auto mesh = make_input(input, static_cast<uint32_t>(trials(200, 2'000)));
    const std::vector<Ray> rays = rays_at(*mesh, 64);
    const std::vector<Hit> hits = brute_force_hits(mesh, rays);
    Tally tally;
    for (const Builder& builder : builders()) {
      for (const BuildSettings& settings : settings_tried) {
        for_each_accel(mesh, build_tree(builder, *mesh, settings),
                       [&](const std::string&, const Accel& accel) {
                         Trial trial(1, 0, tally);
                         check_answers(trial, accel, rays, hits);
                       });
      }
    }
    expect_holds(std::string("answers about ") + input.name, tally);
  }
}

// Reported in seconds a million. A machine under load says nothing about few triangles, so only
// the long form asserts.
TEST(NumericsBuilders, no_input_takes_longer_than_2_seconds_or_3_times_an_ordinary_one) {
  const auto count = static_cast<uint32_t>(trials(50'000, 1'000'000));
  const auto ordinary_mesh = make_input(inputs().back(), count);
  for (const Builder& builder : builders()) {
    const double to_million = 1e6 / count;
    const double usual = to_million * seconds_to_build(builder, *ordinary_mesh, {});
    for (const Input& input : inputs()) {
      const auto mesh = make_input(input, count);
      Tally tally;
      Trial trial(2, 0, tally);
      const double seconds = to_million * seconds_to_build(builder, *mesh, {});
      trial.measure(seconds);
      trial.check(!is_long() || seconds < std::max(2.0, 3 * usual),
                  [&] { return fmt::format("{} s", seconds); });
      expect_holds(fmt::format("seconds a million (worst), {}, {}", builder.name, input.name),
                   tally);
    }
  }
}

/// How many triangles the nodes above leaves hold in all: what a builder has to look at.
uint64_t work_of(const BvhTree& tree) {
  std::vector<uint64_t> below(tree.nodes.size());
  uint64_t work = 0;
  for (size_t i = tree.nodes.size(); i-- > 0;) {
    const BvhNode& node = tree.nodes[i];
    below[i] = node.is_leaf() ? node.count : below[node.first] + below[node.first + 1];
    if (!node.is_leaf()) work += below[i];
  }
  return work;
}

// What time is made of, counted: levels of the tree, and triangles cut.
TEST(NumericsBuilders, no_input_makes_more_than_4_times_the_work_of_a_balanced_tree) {
  const auto count = static_cast<uint32_t>(trials(20'000, 200'000));
  const double levels = std::log2(count);
  for (const Input& input : inputs()) {
    const auto mesh = make_input(input, count);
    const auto boxes = primitive_boxes(*mesh);
    std::atomic<uint64_t> slices{0};
    Primitives primitives = mesh_primitives(*mesh, boxes);
    primitives.slice = [&slices, slice = primitives.slice](uint32_t primitive, int axis,
                                                           std::span<const float> planes,
                                                           std::span<Box4> parts) {
      ++slices;
      slice(primitive, axis, planes, parts);
    };
    Tally tally;
    Trial trial(6, 0, tally);
    for (const Builder& builder : builders()) {
      Progress progress;
      slices = 0;
      const BvhTree tree = builder.build(primitives, {}, progress);
      const double work = static_cast<double>(work_of(tree) + slices) / count;
      trial.measure(work / levels);
      trial.check(work <= 4 * levels, [&] {
        return fmt::format("{}: {} times the levels of a balanced tree", builder.name,
                           work / levels);
      });
    }
    expect_holds(fmt::format("work on {} (worst: of a balanced tree's)", input.name), tally);
  }
}

TEST(NumericsBuilders, no_one_and_two_triangles_are_enough) {
  for (const uint32_t count : {0u, 1u, 2u, 3u}) {
    const auto mesh = make_input(inputs().back(), count);
    std::vector<Ray> rays{{.origin = {0, 0, 5}, .direction = {0, 0, -1}}};
    if (count > 0) rays = rays_at(*mesh, 64);
    const std::vector<Hit> hits = brute_force_hits(mesh, rays);
    Tally tally;
    Trial trial(3, count, tally);
    for (const Builder& builder : builders()) {
      const BvhTree tree = build_tree(builder, *mesh);
      for_each_accel(mesh, tree, [&](const std::string&, const Accel& accel) {
        check_answers(trial, accel, rays, hits);
      });
    }
    expect_holds(fmt::format("answers about {} triangles", count), tally);
  }
}

TEST(NumericsBuilders, few_triangles_of_any_bits_give_valid_trees) {
  const std::string property = "trees over 1 to 70 triangles of any finite bits";
  expect_in_all_trials(property, 4, trials(2'000, 100'000), [](Trial& trial) {
    RandomSource& random = trial.random;
    std::vector<Vec3f> positions;
    std::vector<Vec3u> triangles;
    const auto count = static_cast<uint32_t>(random.integer(1, 70));
    const Input& input = inputs()[random.integer(0, inputs().size() - 1)];
    for (uint32_t i = 0; i < count; ++i) {
      // Some of another kind, among all that are alike.
      const TestTriangle t =
          random.integer(0, 9) == 0 ? of_any_bits(i, count, random) : input.make(i, count, random);
      positions.insert(positions.end(), {t.v0, t.v1, t.v2});
      triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    const Mesh mesh = make_test_mesh(std::move(positions), std::move(triangles));
    const auto boxes = primitive_boxes(mesh);
    BuildSettings settings;
    settings.leaf_size = random.integer(1, 8);
    settings.max_depth = random.integer(1, 64);
    for (const Builder& builder : builders()) {
      const BvhTree tree = build_tree(builder, mesh, settings);
      const std::string fault = validate(tree, mesh_primitives(mesh, boxes), settings.max_depth);
      trial.check(fault.empty(), [&] {
        return fmt::format("{}, {}, leaf size {}, depth {}: {}", builder.name, input.name,
                           settings.leaf_size, settings.max_depth, fault);
      });
    }
  });
}

// One in a hundred is spoilt by what is no number, too large, or leaves no area; a ray at the
// middle of every other.
TEST(NumericsBuilders, triangles_not_finite_or_without_area_are_counted_and_all_others_found) {
  RandomSource random(5);
  const auto count = static_cast<uint32_t>(trials(20'000, 200'000));
  const char* const bad_values[] = {"nan", "inf", "-inf", "1e39", "-NaN"};
  std::string text;
  uint32_t bad_count = 0;
  for (uint32_t i = 0; i < count; ++i) {
    TestTriangle t = ordinary(i, count, random);
    const int spoilt = random.integer(0, 199);
    bad_count += spoilt < 2;
    if (spoilt == 0) t.v2 = t.v1;
    for (const Vec3f& v : {t.v0, t.v1, t.v2}) {
      const std::string y = spoilt == 1 ? bad_values[random.integer(0, 4)] : fmt::format("{}", v.y);
      text += fmt::format("v {} {} {}\n", v.x, y, v.z);
    }
    text += "f -3 -2 -1\n";
  }
  Progress progress;
  ObjFile file = parse_obj(text, "test.obj", progress);
  const ObjMesh loaded = make_mesh(file, "test.obj", progress);
  EXPECT_EQ(loaded.dropped_faces, bad_count);
  EXPECT_GT(bad_count, 0u);
  ASSERT_EQ(loaded.mesh.triangle_count(), count - bad_count);
  const auto mesh = std::make_shared<const Mesh>(loaded.mesh);
  const BvhTree tree = build_tree(builders().front(), *mesh);
  for_each_accel(mesh, tree, [&](const std::string& way, const Accel& accel) {
    const std::string property = "triangles beside 1 % that are not finite, " + way;
    expect_in_all_trials(property, 5, mesh->triangle_count(), [&](Trial& trial) {
      const auto index = static_cast<uint32_t>(trial.index);
      const TestTriangle t = triangle_of(*mesh, index);
      const Vec3f target = (t.v0 + t.v1 + t.v2) / 3.0f;
      const Vec3f normal = glm::normalize(glm::cross(t.v1 - t.v0, t.v2 - t.v0));
      if (!is_finite(normal)) return;
      const Ray ray{.origin = target + 1e-5f * normal, .direction = -normal};
      const StopFlag never;
      RayCaster caster(accel, never);
      // Another may lie in between, but then it is nearer.
      const Hit hit = caster.closest_hit(ray);
      trial.check(hit.primitive == index || (hit.is_hit() && hit.t <= 1.1e-5),
                  [&] { return fmt::format("triangle {}, {}", index, literal(ray)); });
    });
  });
}

}  // namespace
}  // namespace tracer::stress
