// SPDX-License-Identifier: MIT
// The box test against exact arithmetic: no box that a ray meets is ever missed.
#include <cfloat>

#include <gtest/gtest.h>

#include "tests/numerics/rays.h"
#include "tests/numerics/stress.h"
#include "tests/support/exact_integer.h"
#include "tracer/geometry/box.h"

namespace tracer::stress {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Whether a point of the ray lies in the box: every entry is at most every exit, and no exit
/// negative, as fractions of integers.
bool exactly_meets(const Ray& ray, const Box& box) {
  struct Slab {
    ExactInteger entry, exit, speed;
  };
  std::vector<Slab> slabs;
  for (int axis = 0; axis < 3; ++axis) {
    const float direction = ray.direction[axis];
    if (direction == 0) {
      if (ray.origin[axis] < box.min[axis] || ray.origin[axis] > box.max[axis]) return false;
      continue;
    }
    const ExactInteger to_min = ExactInteger(box.min[axis]) - ExactInteger(ray.origin[axis]);
    const ExactInteger to_max = ExactInteger(box.max[axis]) - ExactInteger(ray.origin[axis]);
    if (direction > 0) {
      slabs.push_back({to_min, to_max, ExactInteger(direction)});
    } else {
      slabs.push_back({-to_max, -to_min, ExactInteger(-direction)});
    }
  }
  for (const Slab& a : slabs) {
    if (a.exit.sign() < 0) return false;
    for (const Slab& b : slabs) {
      if ((b.exit * a.speed - a.entry * b.speed).sign() < 0) return false;
    }
  }
  return true;
}

bool is_met(const Ray& ray, const Box& box) {
  const auto [entry, exit] = box.intersect(ray);
  return entry <= exit;
}

std::string replay(const Ray& ray, const Box& box) {
  return "Box{" + literal(box.min) + ", " + literal(box.max) + "}.intersect(" + literal(ray) + ')';
}

struct BoxKind {
  const char* name;
  float size;
  float offset;
  float least_component;       // of one component of the direction; 0 for +-0
  double control_per_million;  // that naive slabs lose at least
};
// Where few bits differ, at 1e5 and among denormals, float arithmetic is right by luck.
constexpr BoxKind box_kinds[] = {
    {"of size 1", 1, 0, 1, 1e4},
    {"of size 1 at 1e5", 1, 1e5f, 1, 0},
    {"of size 1e-6", 1e-6f, 0, 1, 1e4},
    {"of size 1e6", 1e6f, 0, 1, 1e4},
    {"of denormal size", 1e-40f, 0, 1, 0},
    {"met along a plane of +-0", 1, 0, 0, 1e4},
    {"met along a plane by 1e-20", 1, 0, 1e-20f, 1e4},
    {"met along a plane by a denormal", 1, 0, 1e-40f, 1e4},
};

Ray ray_for(const BoxKind& kind, RandomSource& random) {
  Ray ray{.origin = Vec3f(kind.offset) + kind.size * random.vector(-1, 1),
          .direction = random.vector(-1, 1)};
  if (kind.least_component < 1) {
    const float sign = random.integer(0, 1) == 0 ? 1.0f : -1.0f;
    ray.direction[random.integer(0, 2)] = sign * kind.least_component;
  }
  if (random.integer(0, 1) == 0) ray.direction *= kind.size;
  return ray;
}

/// Its sides pass within a unit in the last place of points of the ray; flat ones among them.
Box tight_box(const Ray& ray, float size, RandomSource& random) {
  Box box;
  const double shared_distance = static_cast<double>(random.unit());
  const double speed = max_abs(Vec3d(ray.direction));
  for (int axis = 0; axis < 3; ++axis) {
    const double distance = shared_distance * (speed > 0 ? static_cast<double>(size) / speed : 1);
    auto side = static_cast<float>(static_cast<double>(ray.origin[axis]) +
                                   distance * static_cast<double>(ray.direction[axis]));
    const int nudge = random.integer(-1, 1);
    if (nudge != 0) side = std::nextafter(side, nudge > 0 ? infinity : -infinity);
    const float thickness = random.integer(0, 5) == 0 ? 0 : size * random.unit();
    box.min[axis] = random.integer(0, 1) == 0 ? side : side - thickness;
    box.max[axis] = box.min[axis] == side ? side + thickness : side;
  }
  return box;
}

TEST(NumericsBoxes, tight_boxes_that_a_ray_meets_are_never_missed) {
  for (const BoxKind& kind : box_kinds) {
    const std::string property = std::string("tight boxes ") + kind.name;
    const Tally tally = run_trials(property, 11, trials(200'000, 8'000'000), [&](Trial& trial) {
      const Ray ray = ray_for(kind, trial.random);
      const Box box = tight_box(ray, kind.size, trial.random);
      if (ray.direction == Vec3f(0) || !exactly_meets(ray, box)) return;
      trial.check(is_met(ray, box), [&] { return replay(ray, box); });
      trial.check_control(naive_slabs(ray, box));
    });
    expect_holds_and_control_fails(property, tally, kind.control_per_million);
  }
}

TEST(NumericsBoxes, padding_lets_in_less_than_one_ray_in_100_000_that_misses) {
  expect_in_all_trials("false hits of boxes, in groups of 100,000", 12, trials(20, 1000),
                       [](Trial& trial) {
                         RandomSource& random = trial.random;
                         int false_hits = 0;
                         for (int i = 0; i < 100'000; ++i) {
                           const Ray ray = ray_for(box_kinds[0], random);
                           Box box;
                           box.extend(random.vector(-1, 1));
                           box.extend(random.vector(-1, 1));
                           false_hits += is_met(ray, box) && !exactly_meets(ray, box);
                         }
                         trial.measure(false_hits);
                         trial.check(false_hits <= 1, [] { return std::string("more than one"); });
                       });
}

// Lower and upper faces alike, with +0, -0 and with what is almost 0.
TEST(NumericsBoxes, a_ray_along_a_face_meets_the_box_from_either_face) {
  const Tally tally = run_trials(
      "rays along lower and upper faces", 13, trials(300'000, 20'000'000), [](Trial& trial) {
        RandomSource& random = trial.random;
        Box box;
        box.extend(random.vector(-1, 1));
        box.extend(random.vector(-1, 1));
        const int axis = random.integer(0, 2);
        Vec3f origin = 0.5f * (box.min + box.max);
        origin[axis] = random.integer(0, 1) == 0 ? box.min[axis] : box.max[axis];
        Vec3f direction(random.integer(0, 1) == 0 ? 0.0f : -0.0f);
        direction[(axis + 1) % 3] = random.integer(0, 1) == 0 ? 1.0f : -1.0f;
        if (random.integer(0, 1) == 0) origin -= 8.0f * direction;
        const Ray ray{.origin = origin, .direction = direction};
        trial.check(is_met(ray, box), [&] { return replay(ray, box); });
        trial.check_control(naive_slabs(ray, box));
        Ray beside = ray;
        const bool is_lower = origin[axis] == box.min[axis];
        beside.origin[axis] = std::nextafter(origin[axis], is_lower ? -2.0f : 2.0f);
        if (box.min[axis] == box.max[axis]) return;
        trial.check(!is_met(beside, box), [&] { return replay(beside, box); });
      });
  expect_holds_and_control_fails("rays along lower and upper faces", tally, 1e4);
}

TEST(NumericsBoxes, empty_boxes_are_never_met_and_infinite_ones_wherever_they_reach) {
  expect_in_all_trials("empty and infinite boxes", 14, trials(300'000, 20'000'000),
                       [](Trial& trial) {
                         RandomSource& random = trial.random;
                         Ray ray = ray_for(box_kinds[random.integer(0, 7)], random);
                         if (ray.direction == Vec3f(0)) return;
                         trial.check(!is_met(ray, Box()), [&] { return replay(ray, Box()); });
                         Box whole{Vec3f(-infinity), Vec3f(infinity)};
                         trial.check(is_met(ray, whole), [&] { return replay(ray, whole); });
                         // Half of all space: met from within, or when the ray goes there.
                         const int axis = random.integer(0, 2);
                         whole.max[axis] = ray.origin[axis];
                         trial.check(is_met(ray, whole), [&] { return replay(ray, whole); });
                         whole.max[axis] = std::nextafter(ray.origin[axis], -infinity);
                         const bool goes_there = ray.direction[axis] < 0;
                         // Where it goes almost along the plane, its distance may be none at all in
                         // double.
                         if (!goes_there) {
                           trial.check(!is_met(ray, whole), [&] { return replay(ray, whole); });
                         } else {
                           trial.check(is_met(ray, whole), [&] { return replay(ray, whole); });
                         }
                       });
}

TEST(NumericsBoxes, entry_and_exit_of_any_ray_are_numbers_in_order_or_a_miss) {
  constexpr float bad_values[] = {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity};
  expect_in_all_trials(
      "rays with NaN and infinity", 15, trials(300'000, 20'000'000), [&](Trial& trial) {
        RandomSource& random = trial.random;
        Ray ray = ray_for(box_kinds[0], random);
        (random.integer(0, 1) == 0 ? ray.origin : ray.direction)[random.integer(0, 2)] =
            bad_values[random.integer(0, 2)];
        Box box;
        box.extend(random.vector(-1, 1));
        box.extend(random.vector(-1, 1));
        const auto [entry, exit] = box.intersect(ray);
        const bool is_miss = entry == FLT_MAX && exit == -FLT_MAX;
        trial.check(is_miss || entry <= exit, [&] { return replay(ray, box); });
      });
}

}  // namespace
}  // namespace tracer::stress
