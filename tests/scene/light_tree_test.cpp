// SPDX-License-Identifier: MIT
#include "tracer/scene/light_tree.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/instruction_sets.h"
#include "tests/support/light_statistics.h"
#include "tracer/base/directions.h"

namespace tracer {
namespace {

using Random = std::mt19937;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3d random_direction(Random& random) {
  Vec3d v;
  do {
    v = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
  } while (glm::dot(v, v) > 1);
  return unit_or(v, {0, 1, 0});
}

/// Small lights in a cube, of powers that differ a thousandfold.
std::vector<LightBounds> random_lights(size_t count, Random& random) {
  std::vector<LightBounds> lights(count);
  for (LightBounds& light : lights) {
    const Vec3d center(uniform(random, -5, 5), uniform(random, -5, 5), uniform(random, -5, 5));
    for (int corner = 0; corner < 3; ++corner) {
      light.box.extend(Vec3f(center + 0.1 * random_direction(random)));
    }
    light.normal = random_direction(random);
    light.power = std::pow(10.0, uniform(random, -3, 0));
  }
  return lights;
}

LightReceiver random_receiver(Random& random, double reach) {
  return {Vec3f(Vec3d(uniform(random, -reach, reach), uniform(random, -reach, reach),
                      uniform(random, -reach, reach))),
          Vec3f(random_direction(random))};
}

TEST(LightTree, probabilities_of_all_lights_sum_to_one_anywhere) {
  Random random(1);
  for (const size_t count : {1, 2, 8, 9, 65, 3000}) {
    const LightTree tree(random_lights(count, random));
    for (const double reach : {1.0, 8.0, 1e4, 1e30}) {
      const LightReceiver receiver = random_receiver(random, reach);
      double sum = 0;
      for (uint32_t light = 0; light < count; ++light) sum += tree.probability(receiver, light);
      EXPECT_NEAR(sum, 1, 1e-9) << count << " lights, " << reach;
    }
  }
}

TEST(LightTree, a_pick_says_the_probability_that_is_asked_for_later) {
  Random random(2);
  const LightTree tree(random_lights(700, random));
  for (int i = 0; i < 20'000; ++i) {
    const LightReceiver receiver = random_receiver(random, i % 2 ? 6 : 60);
    const LightTree::Pick pick = tree.pick(receiver, uniform(random, 0, 1));
    ASSERT_GT(pick.probability, 0);
    ASSERT_NEAR(pick.probability / tree.probability(receiver, pick.light), 1, 1e-12);
  }
}

TEST(LightTree, picks_have_the_same_bits_alone_and_together_with_every_instruction_set) {
  Random random(9);
  const LightTree tree(random_lights(700, random));
  std::vector<LightReceiver> receivers;
  std::vector<double> u;
  for (int i = 0; i < 1000; ++i) {
    receivers.push_back(random_receiver(random, i % 2 ? 6 : 1e6));
    u.push_back(i == 0 ? 0 : i == 1 ? 1 - 0x1p-53 : uniform(random, 0, 1));
  }
  std::vector<LightTree::Pick> expected;
  std::vector<double> probabilities;
  for (size_t i = 0; i < u.size(); ++i) {
    expected.push_back(tree.pick(receivers[i], u[i]));
    probabilities.push_back(tree.probability(receivers[i], static_cast<uint32_t>(i % 700)));
  }
  for_each_instruction_set([&](const char* name) {
    std::vector<LightTree::Pick> picks(u.size());
    tree.pick(receivers, u, picks);
    for (size_t i = 0; i < u.size(); ++i) {
      ASSERT_EQ(picks[i].light, expected[i].light) << name << ' ' << i;
      ASSERT_EQ(picks[i].probability, expected[i].probability) << name << ' ' << i;
      ASSERT_EQ(tree.probability(receivers[i], static_cast<uint32_t>(i % 700)), probabilities[i])
          << name << ' ' << i;
    }
  });
}

struct Counts {
  std::vector<double> picked, by_probability, by_power;
};
Counts count_picks(size_t light_count, int pick_count) {
  Random random(3);
  const std::vector<LightBounds> lights = random_lights(light_count, random);
  const LightTree tree(lights);
  const LightReceiver receiver{{1, 2, -1}, {0, 0.6f, 0.8f}};
  Counts counts{std::vector<double>(light_count), std::vector<double>(light_count),
                std::vector<double>(light_count)};
  double power = 0;
  for (const LightBounds& light : lights) power += light.power;
  for (uint32_t light = 0; light < light_count; ++light) {
    counts.by_probability[light] = pick_count * tree.probability(receiver, light);
    counts.by_power[light] = pick_count * lights[light].power / power;
  }
  for (int i = 0; i < pick_count; ++i) {
    ++counts.picked[tree.pick(receiver, uniform(random, 0, 1)).light];
  }
  return counts;
}

TEST(LightTree, lights_are_picked_as_often_as_their_probabilities_say) {
  const Counts counts = count_picks(300, 1'000'000);
  EXPECT_LT(std::abs(test::chi_square_deviation(counts.picked, counts.by_probability)), 5);
  EXPECT_GT(test::chi_square_deviation(counts.picked, counts.by_power), 1000) << "the control";
}

TEST(LightTree, what_can_be_lit_by_a_light_can_pick_it_and_lights_below_seldom_are) {
  Random random(4);
  const std::vector<LightBounds> lights = random_lights(200, random);
  const LightTree tree(lights);
  double wasted = 0;
  int receivers = 0;
  for (int i = 0; i < 500; ++i) {
    const LightReceiver receiver = random_receiver(random, 4);
    double below = 0;
    bool is_any_above = false;
    for (uint32_t light = 0; light < lights.size(); ++light) {
      const double probability = tree.probability(receiver, light);
      bool is_above = false, is_below = true;
      for (int corner = 0; corner < 8; ++corner) {
        const Box& box = lights[light].box;
        const Vec3f point(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                          corner & 4 ? box.max.z : box.min.z);
        const float height = glm::dot(point - receiver.position, receiver.normal);
        is_above |= height > 0;
        is_below &= height < -0.2f;
      }
      if (is_above) {
        ASSERT_GT(probability, 0);
      }
      if (is_below) below += probability;
      is_any_above |= is_above;
    }
    // Where nothing can be of use, any light is picked.
    if (!is_any_above) continue;
    wasted += below;
    ++receivers;
  }
  EXPECT_GT(receivers, 400);
  EXPECT_LT(wasted / receivers, 0.1);
}

TEST(LightTree, near_lights_and_those_that_face_the_receiver_come_first) {
  LightBounds near{.box = {{1, 1, 0}, {1.1f, 1, 0.1f}}, .normal = {0, 1, 0}, .power = 1};
  LightBounds far = near;
  far.box = {{1, 10, 0}, {1.1f, 10, 0.1f}};
  LightBounds edge_on = near;
  edge_on.box = {{1, 1, 0}, {1.1f, 1.1f, 0}};
  edge_on.normal = {0, 0, 1};
  const LightReceiver receiver{{1, 0, 0}, {0, 1, 0}};
  const LightTree by_distance(std::vector{near, far});
  EXPECT_NEAR(by_distance.probability(receiver, 0), 100.0 / 101, 0.01);
  const LightTree by_side(std::vector{near, edge_on});
  EXPECT_GT(by_side.probability(receiver, 0), 0.8);
}

TEST(LightTree, neither_coincident_nor_far_apart_nor_faint_lights_upset_it) {
  Random random(5);
  LightBounds point{.box = {{1, 1, 1}, {1, 1, 1}}, .normal = {0, 1, 0}, .power = 1};
  std::vector<std::vector<LightBounds>> cases;
  cases.emplace_back(5000, point);
  std::vector<LightBounds> far_apart(2000, point);
  for (size_t i = 0; i < far_apart.size(); ++i) {
    const auto place = static_cast<float>(std::pow(1.08, static_cast<double>(i % 1000)));
    far_apart[i].box = {Vec3f(place), Vec3f(place)};
  }
  cases.push_back(far_apart);
  std::vector<LightBounds> faint = random_lights(100, random);
  for (size_t i = 0; i < faint.size(); i += 2) faint[i].power = 1e-300;
  cases.push_back(faint);
  for (const std::vector<LightBounds>& lights : cases) {
    const LightTree tree(lights);
    for (const double reach : {2.0, 1e6, 1e37}) {
      const LightReceiver receiver = random_receiver(random, reach);
      double sum = 0;
      for (uint32_t light = 0; light < lights.size(); ++light) {
        sum += tree.probability(receiver, light);
      }
      EXPECT_NEAR(sum, 1, 1e-6);
      for (const double u : {0.0, 0.3, 1 - 0x1p-24}) {
        EXPECT_GT(tree.pick(receiver, u).probability, 0);
      }
    }
    EXPECT_GT(tree.pick({{1, 1, 1}, {0, 1, 0}}, 0.5).probability, 0) << "within a light";
  }
}

}  // namespace
}  // namespace tracer
