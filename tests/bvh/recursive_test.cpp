// SPDX-License-Identifier: MIT
// Builders and the recursive traversal know boxes, centres and an intersect function, and nothing
// of triangles: here they trace spheres.
#include "tracer/bvh/trace/recursive.h"

#include <gtest/gtest.h>

#include "tests/support/random_source.h"
#include "tracer/bvh/build.h"

namespace tracer {
namespace {

struct Sphere {
  Vec3f center;
  float radius;

  // Room for the rounding of the roots below.
  Box bounds() const { return {center - 1.001f * radius, center + 1.001f * radius}; }

  Hit intersect(const Ray& ray, uint32_t primitive) const {
    const Vec3d direction(ray.direction);
    const Vec3d to_center = Vec3d(center) - Vec3d(ray.origin);
    const double length_squared = glm::dot(direction, direction);
    const double middle = glm::dot(to_center, direction) / length_squared;
    const Vec3d offset = to_center - middle * direction;
    const double discriminant = static_cast<double>(radius) * radius - glm::dot(offset, offset);
    if (discriminant < 0) return {};
    const double half_chord = std::sqrt(discriminant / length_squared);
    for (const double t : {middle - half_chord, middle + half_chord}) {
      if (t >= ray.t_min && t <= ray.t_max) return {.t = t, .primitive = primitive};
    }
    return {};
  }
};

class Spheres : public testing::Test {
 protected:
  Spheres() {
    RandomSource random(1);
    for (int i = 0; i < 400; ++i) {
      spheres_.push_back({random.vector(-1, 1), 0.1f * random.unit() + 0.01f});
      boxes_.push_back(spheres_.back().bounds());
    }
  }

  auto intersector() {
    return [this](uint32_t primitive, const Ray& ray) {
      ++test_count_;
      return spheres_[primitive].intersect(ray, primitive);
    };
  }
  BvhTree build(const Builder& builder) const {
    Progress progress;
    return builder.build(boxes_, {}, progress);
  }
  Hit brute_force(const Ray& ray) const {
    Hit best;
    for (uint32_t i = 0; i < spheres_.size(); ++i) {
      const Hit hit = spheres_[i].intersect(ray, i);
      if (hit.is_hit() && hit.is_closer_than(best)) best = hit;
    }
    return best;
  }
  static Ray random_ray(RandomSource& random) {
    const Vec3f origin = random.vector(-2, 2);
    const double t_min = random.integer(0, 1) * 0.5 * random.unit();
    const double t_max =
        random.integer(0, 1) == 0 ? t_min + random.unit() : std::numeric_limits<double>::infinity();
    return {origin, random.vector(-1, 1) - origin, t_min, t_max};
  }

  std::vector<Sphere> spheres_;
  std::vector<Box> boxes_;
  uint64_t test_count_ = 0;
};

TEST_F(Spheres, closest_hits_are_those_of_brute_force) {
  for (const Builder& builder : builders()) {
    const BvhTree tree = build(builder);
    RandomSource random(2);
    int hit_count = 0;
    for (int i = 0; i < 20000; ++i) {
      const Ray ray = random_ray(random);
      const Hit hit = closest_hit_recursive(tree, ray, intersector());
      const Hit expected = brute_force(ray);
      ASSERT_EQ(hit.primitive, expected.primitive) << builder.name << ", ray " << i;
      ASSERT_EQ(hit.t, expected.t);
      hit_count += hit.is_hit();
    }
    EXPECT_GT(hit_count, 5000);
    EXPECT_LT(hit_count, 19000);
  }
}

TEST_F(Spheres, occlusion_is_whether_brute_force_hits) {
  for (const Builder& builder : builders()) {
    const BvhTree tree = build(builder);
    RandomSource random(3);
    for (int i = 0; i < 20000; ++i) {
      const Ray ray = random_ray(random);
      ASSERT_EQ(occluded_recursive(tree, ray, intersector()), brute_force(ray).is_hit())
          << builder.name << ", ray " << i;
    }
  }
}

TEST_F(Spheres, few_of_them_are_tested) {
  for (const Builder& builder : builders()) {
    const BvhTree tree = build(builder);
    RandomSource random(4);
    test_count_ = 0;
    constexpr int ray_count = 2000;
    for (int i = 0; i < ray_count; ++i) {
      closest_hit_recursive(tree, random_ray(random), intersector());
    }
    EXPECT_LT(test_count_, ray_count * spheres_.size() / 10) << builder.name;
  }
}

// The far child is skipped where the near child's hit is closer than its entry.
TEST(Recursive, what_lies_behind_the_hit_is_not_tested) {
  std::vector<Box> boxes;
  for (int i = 0; i < 64; ++i) {
    const auto x = static_cast<float>(2 * i);
    boxes.push_back({Vec3f(x, -1, -1), Vec3f(x + 1, 1, 1)});
  }
  for (const Builder& builder : builders()) {
    Progress progress;
    const BvhTree tree = builder.build(boxes, {.max_depth = 30, .leaf_size = 1}, progress);
    for (const uint32_t first : {0u, 17u, 63u}) {
      std::vector<uint32_t> tested;
      const Ray ray{.origin{2 * static_cast<float>(first) - 0.5f, 0, 0}, .direction{1, 0, 0}};
      const Hit hit = closest_hit_recursive(tree, ray, [&](uint32_t primitive, const Ray& r) {
        tested.push_back(primitive);
        return Hit{.t = boxes[primitive].min.x - double{r.origin.x}, .primitive = primitive};
      });
      EXPECT_EQ(hit.primitive, first);
      EXPECT_EQ(tested, std::vector<uint32_t>{first}) << builder.name;
    }
  }
}

TEST(Recursive, of_hits_at_the_same_distance_the_lowest_primitive_counts) {
  const std::vector<Box> boxes(50, Box{Vec3f(1, -1, -1), Vec3f(2, 1, 1)});
  for (const Builder& builder : builders()) {
    Progress progress;
    const BvhTree tree = builder.build(boxes, {.max_depth = 30, .leaf_size = 1}, progress);
    const Hit hit = closest_hit_recursive(
        tree, {.origin{0, 0, 0}, .direction{1, 0, 0}},
        [](uint32_t primitive, const Ray&) { return Hit{.t = 1, .primitive = primitive}; });
    EXPECT_EQ(hit.primitive, 0u) << builder.name;
  }
}

TEST(Recursive, an_empty_tree_is_never_hit) {
  const auto never = [](uint32_t, const Ray&) { return Hit{.t = 0, .primitive = 0}; };
  const Ray ray{.origin{0, 0, 0}, .direction{1, 0, 0}};
  EXPECT_FALSE(closest_hit_recursive(BvhTree(), ray, never).is_hit());
  EXPECT_FALSE(occluded_recursive(BvhTree(), ray, never));
}

}  // namespace
}  // namespace tracer
