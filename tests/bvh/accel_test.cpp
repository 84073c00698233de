// SPDX-License-Identifier: MIT
#include "tracer/bvh/trace/accel.h"

#include <gtest/gtest.h>

#include "tests/support/same_bits.h"
#include "tests/support/test_meshes.h"
#include "tracer/bvh/build.h"

namespace tracer {
namespace {

const std::string cow_path = BOXWOOD_SHARED_DIR "/models/cow.obj";

Vec3f point_on(const Mesh& mesh, uint32_t triangle, float u, float v) {
  const Vec3u& index = mesh.triangles[triangle];
  return (1 - u - v) * mesh.positions[index.x] + u * mesh.positions[index.y] +
         v * mesh.positions[index.z];
}

// From near and far, along axes and not, at vertices, edges, inner points, and anywhere.
std::vector<Ray> probing_rays(const Mesh& mesh, int count, uint32_t seed) {
  RandomSource random(seed);
  const auto reach = static_cast<float>(max_abs(mesh.bounds.extent()));
  const Vec3f center = mesh.bounds.center();
  std::vector<Ray> rays;
  while (rays.size() < static_cast<size_t>(count)) {
    const auto triangle = static_cast<uint32_t>(random.integer(0, int(mesh.triangle_count()) - 1));
    const float u = random.unit();
    const Vec3f targets[] = {point_on(mesh, triangle, 0, 0), point_on(mesh, triangle, u, 0),
                             point_on(mesh, triangle, u, 1 - u),
                             point_on(mesh, triangle, 0.5f * u, 0.3f),
                             center + reach * random.vector(-0.5f, 0.5f)};
    const Vec3f& target = targets[random.integer(0, 4)];
    Vec3f axis(0);
    axis[random.integer(0, 2)] = random.integer(0, 1) == 0 ? -reach : reach;
    const Vec3f origins[] = {center + reach * random.vector(-1, 1),
                             center + 1e5f * reach * random.vector(-1, 1), target - axis,
                             point_on(mesh, triangle, 0.25f, 0.25f)};
    const Vec3f& origin = origins[random.integer(0, 3)];
    if (target == origin) continue;
    rays.push_back({.origin = origin, .direction = target - origin});
    if (random.integer(0, 3) == 0) rays.back().t_min = random.unit();
    if (random.integer(0, 3) == 0) rays.back().t_max = 2 * random.unit() + rays.back().t_min;
  }
  return rays;
}

struct Answer {
  Hit hit;
  bool is_occluded;
};

std::vector<Answer> answers(const Accel& accel, const std::vector<Ray>& rays) {
  const StopFlag stop;
  RayCaster caster(accel, stop);
  std::vector<Answer> answers;
  for (const Ray& ray : rays) answers.push_back({caster.closest_hit(ray), caster.occluded(ray)});
  EXPECT_EQ(caster.ray_count(), 2 * rays.size());
  return answers;
}

void expect_trees_to_answer_as_brute_force(const Mesh& mesh, const std::vector<Ray>& rays) {
  Accel accel{std::make_shared<const Mesh>(mesh)};
  const std::vector<Answer> expected = answers(accel, rays);
  int hit_count = 0;
  for (const Answer& answer : expected) {
    ASSERT_EQ(answer.hit.is_hit(), answer.is_occluded);
    hit_count += answer.is_occluded;
  }
  EXPECT_GT(hit_count, static_cast<int>(rays.size() / 20));
  const auto boxes = primitive_boxes(mesh);
  for (const Builder& builder : builders()) {
    for (const int max_depth : {1, 5, 30, 64}) {
      for (const int leaf_size : {1, 4, 64}) {
        Progress progress;
        accel.tree = std::make_shared<const BvhTree>(
            builder.build(mesh_primitives(mesh, boxes), {max_depth, leaf_size}, progress));
        const std::vector<Answer> found = answers(accel, rays);
        for (size_t i = 0; i < rays.size(); ++i) {
          ASSERT_TRUE(are_same_bits(found[i].hit, expected[i].hit) &&
                      found[i].is_occluded == expected[i].is_occluded)
              << builder.name << ", depth " << max_depth << ", leaf " << leaf_size << ", ray " << i;
        }
      }
    }
  }
}

TEST(Accel, a_tree_never_changes_a_bit_on_a_random_soup) {
  const Mesh mesh = random_soup(500, 0.2f, 1);
  expect_trees_to_answer_as_brute_force(mesh, probing_rays(mesh, 1500, 1));
}

TEST(Accel, a_tree_never_changes_a_bit_on_a_closed_surface) {
  const Mesh mesh = rough_ball(8, 0.1f, 2);
  expect_trees_to_answer_as_brute_force(mesh, probing_rays(mesh, 1500, 2));
}

TEST(Accel, a_tree_never_changes_a_bit_on_duplicates) {
  const Mesh mesh = repeated(rough_ball(4, 0.1f, 3), 5);
  expect_trees_to_answer_as_brute_force(mesh, probing_rays(mesh, 1000, 3));
}

TEST(Accel, a_tree_never_changes_a_bit_on_axis_parallel_quads_and_rays) {
  const Mesh mesh = lattice_quads(250, 4);
  std::vector<Ray> rays = probing_rays(mesh, 800, 4);
  RandomSource random(4);
  while (rays.size() < 2000) {
    const Vec3f direction = random.lattice(-1, 1);
    if (direction == Vec3f(0)) continue;
    rays.push_back({.origin = 0.5f * random.lattice(-7, 7), .direction = -direction});
  }
  expect_trees_to_answer_as_brute_force(mesh, rays);
}

TEST(Accel, a_tree_never_changes_a_bit_far_from_the_origin) {
  const Mesh mesh = moved(rough_ball(6, 0.1f, 5), Vec3f(1000, -2000, 1e4f));
  expect_trees_to_answer_as_brute_force(mesh, probing_rays(mesh, 1000, 5));
}

TEST(Accel, a_tree_never_changes_a_bit_on_the_cow) {
  const Mesh mesh = read_plain_obj(cow_path);
  if (mesh.triangles.empty()) GTEST_SKIP() << cow_path << " is missing";
  expect_trees_to_answer_as_brute_force(mesh, probing_rays(mesh, 600, 6));
}

TEST(Accel, a_mesh_without_triangles_is_never_hit) {
  Progress progress;
  const StopFlag stop;
  const auto mesh = std::make_shared<const Mesh>();
  for (const Accel& accel : {Accel{mesh}, Accel{mesh, std::make_shared<const BvhTree>()}}) {
    RayCaster caster(accel, stop);
    EXPECT_FALSE(caster.closest_hit({.origin{0, 0, 0}, .direction{1, 0, 0}}).is_hit());
    EXPECT_FALSE(caster.occluded({.origin{0, 0, 0}, .direction{1, 0, 0}}));
  }
}

TEST(Accel, rays_answer_with_a_miss_once_stopped) {
  const auto mesh = std::make_shared<const Mesh>(rough_ball(30, 0, 1));
  Progress progress;
  const BvhTree tree = builders()[0].build(primitive_boxes(*mesh), {}, progress);
  std::vector<Accel> accels{{mesh}};
  for (const Layout& layout : layouts()) {
    accels.push_back(make_accel(mesh, tree, layout, progress));
  }
  for (const Accel& accel : accels) {
    StopFlag stop;
    RayCaster caster(accel, stop);
    const Ray ray{.origin{0, 0, 0}, .direction{1, 0.1f, 0}};
    EXPECT_TRUE(caster.closest_hit(ray).is_hit());
    EXPECT_TRUE(caster.occluded(ray));
    stop.request();
    EXPECT_FALSE(caster.closest_hit(ray).is_hit());
    EXPECT_FALSE(caster.occluded(ray));
  }
}

}  // namespace
}  // namespace tracer
