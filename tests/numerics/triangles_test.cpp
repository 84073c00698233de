// SPDX-License-Identifier: MIT
// The exact triangle test, alone: verdicts, distances, degenerate input, symmetry.
#include <cfloat>
#include <span>

#include <gtest/gtest.h>

#include "tests/numerics/rays.h"
#include "tests/numerics/stress.h"
#include "tests/support/exact_hit.h"
#include "tracer/geometry/triangle.h"

namespace tracer::stress {
namespace {

std::optional<TriangleHit> intersect(const Ray& ray, const TestTriangle& triangle) {
  return intersect_triangle(ray, triangle.v0, triangle.v1, triangle.v2);
}

std::string replay(const Ray& ray, const TestTriangle& triangle) {
  return "intersect_triangle(" + literal(ray) + ", " + literal(triangle) + ')';
}

struct Aim {
  Ray ray;
  TestTriangle triangle;
};

TestTriangle any_triangle(RandomSource& random) {
  const Vec3f v0 = random.vector(-1, 1);
  const Vec3f v1 = random.vector(-1, 1);
  return {v0, v1, random.vector(-1, 1)};
}

Ray ray_to(const Vec3f& target, float distance, RandomSource& random) {
  const Vec3f origin = target + distance * random.vector(-1, 1);
  Ray ray{.origin = origin, .direction = target - origin};
  if (random.integer(0, 1) == 0) ray.direction *= std::exp2(random.between(-20, 20));
  return ray;
}

Vec3f point_in(const TestTriangle& t, RandomSource& random) {
  const float u = random.unit();
  return t.v0 + u * (t.v1 - t.v0) + (1 - u) * random.unit() * (t.v2 - t.v0);
}

Aim random_aim(RandomSource& random) {
  const TestTriangle triangle = any_triangle(random);
  return {ray_to(random.vector(-1, 1), 3, random), triangle};
}
Aim edge_aim(RandomSource& random) {
  const TestTriangle t = any_triangle(random);
  return {ray_to(glm::mix(t.v0, t.v1, random.unit()), 3, random), t};
}
Aim vertex_aim(RandomSource& random) {
  const TestTriangle t = any_triangle(random);
  return {ray_to(t.v2, 3, random), t};
}
// Directions almost in the plane, of slivers as well.
Aim grazing_aim(RandomSource& random) {
  TestTriangle t = any_triangle(random);
  const float thickness = std::exp2(random.between(-30, 0));
  if (random.integer(0, 1) == 0) {
    t.v2 = glm::mix(t.v0, t.v1, 0.4f) + thickness * random.vector(-1, 1);
  }
  const Vec3f direction = t.v1 - t.v0 + thickness * random.vector(-1, 1);
  const Vec3f target = random.integer(0, 1) == 0 ? point_in(t, random) : t.v2;
  return {{.origin = target - direction, .direction = direction}, t};
}
// From up to a million sizes away, at insides, edges and vertices.
Aim far_aim(RandomSource& random) {
  const TestTriangle t = any_triangle(random);
  const Vec3f targets[] = {point_in(t, random), glm::mix(t.v1, t.v2, random.unit()), t.v0};
  return {ray_to(targets[random.integer(0, 2)], std::exp2(random.between(0, 20)), random), t};
}
// From the triangle itself, and along its edges.
Aim aim_from_within(RandomSource& random) {
  const TestTriangle t = any_triangle(random);
  const Vec3f on_edge = glm::mix(t.v0, t.v1, random.unit());
  const Vec3f origins[] = {on_edge, t.v2, point_in(t, random)};
  const Vec3f directions[] = {random.vector(-1, 1), t.v1 - t.v0, t.v2 - on_edge};
  return {{.origin = origins[random.integer(0, 2)], .direction = directions[random.integer(0, 2)]},
          t};
}
Aim offset_aim(RandomSource& random) {
  const Vec3f offset(1e5f, -7e4f, 3e4f);
  const TestTriangle t = any_triangle(random);
  const TestTriangle moved{offset + t.v0, offset + t.v1, offset + t.v2};
  const Vec3f targets[] = {point_in(moved, random), glm::mix(moved.v0, moved.v1, random.unit()),
                           moved.v1};
  return {ray_to(targets[random.integer(0, 2)], 3, random), moved};
}
// Rays through edges and vertices, in the plane, and triangles without area are common.
Aim lattice_aim(RandomSource& random) {
  const TestTriangle t{random.lattice(-3, 3), random.lattice(-3, 3), random.lattice(-3, 3)};
  const Vec3f origin = random.lattice(-3, 3);
  Vec3f direction = random.lattice(-2, 2);
  while (direction == Vec3f(0)) direction = random.lattice(-2, 2);
  return {{.origin = origin, .direction = direction}, t};
}
Aim any_bits_aim(RandomSource& random) {
  const auto vector = [&] {
    const float x = random.finite_bits();
    const float y = random.finite_bits();
    return Vec3f(x, y, random.finite_bits());
  };
  const TestTriangle t{vector(), vector(), vector()};
  const Vec3f origin = vector();
  const Vec3f toward = 0.5f * t.v0 + 0.25f * t.v1 + 0.25f * t.v2;
  Vec3f direction = random.integer(0, 1) == 0 ? 0.5f * toward - 0.5f * origin : vector();
  if (direction == Vec3f(0)) direction = {1, 0, 0};
  return {{.origin = origin, .direction = direction}, t};
}

struct AimKind {
  const char* name;
  Aim (*make)(RandomSource& random);
};
constexpr AimKind aim_kinds[] = {
    {"at random", random_aim},
    {"at edges", edge_aim},
    {"at vertices", vertex_aim},
    {"almost in the plane", grazing_aim},
    {"from afar, to 1e6", far_aim},
    {"at an offset of 1e5", offset_aim},
    {"from within", aim_from_within},
    {"on a lattice", lattice_aim},
    {"of any finite bits", any_bits_aim},
};

TEST(NumericsTriangles, verdicts_are_those_of_exact_integers) {
  for (const auto& [name, make_aim] : aim_kinds) {
    const std::string property = std::string("verdicts of rays ") + name;
    const Tally tally = run_trials(property, 1, trials(100'000, 12'500'000), [&](Trial& trial) {
      const auto [ray, triangle] = make_aim(trial.random);
      const ExactHit exact = exact_hit(ray, triangle.v0, triangle.v1, triangle.v2);
      const bool is_hit = exact.is_hit && exact.t >= 0;
      trial.check(intersect(ray, triangle).has_value() == is_hit,
                  [&] { return replay(ray, triangle); });
      trial.check_control(moeller_trumbore(ray, triangle) == is_hit);
    });
    // Float formulas are right too where they are exact, and mostly away from edges.
    const bool is_easy = make_aim == random_aim || make_aim == lattice_aim;
    expect_holds_and_control_fails(property, tally, is_easy ? 0 : 1e3);
  }
}

/// |t - exact| in units of the last place of a number of so many binary digits.
double ulps(long double t, long double exact, int digits) {
  int exponent = 0;
  std::frexp(static_cast<double>(exact), &exponent);
  return static_cast<double>(std::ldexp(std::abs(t - exact), digits - exponent));
}
double double_ulps(double t, long double exact) {
  return ulps(t, exact, DBL_MANT_DIG);
}
double float_ulps(double t, long double exact) {
  return ulps(static_cast<float>(t), exact, FLT_MANT_DIG);
}

void expect_distances_within(const char* what, double most,
                             double (*error_of)(double t, long double exact)) {
  for (const auto& [name, make_aim] : aim_kinds) {
    const std::string property = std::string(what) + " of rays " + name;
    expect_in_all_trials(property, 2, trials(100'000, 3'000'000), [&](Trial& trial) {
      const auto [ray, triangle] = make_aim(trial.random);
      const auto hit = intersect(ray, triangle);
      // Distances of any bits reach beyond what a float can be rounded to.
      if (!hit || hit->t < FLT_MIN || hit->t > FLT_MAX / 2) return;
      const ExactHit exact = exact_hit(ray, triangle.v0, triangle.v1, triangle.v2);
      const double error = error_of(hit->t, exact.t);
      trial.check(error <= most, [&] { return replay(ray, triangle); });
      trial.measure(error);
    });
  }
}

// t is a double, certified to 2^-32: 2^21 units of a double's last place.
TEST(NumericsTriangles, t_is_within_2_to_the_minus_32) {
  expect_distances_within("t in ulp of double", 0x1p21, double_ulps);
}

// Half is the best there can be.
TEST(NumericsTriangles, t_rounded_to_float_is_within_0_51_ulp) {
  expect_distances_within("t in ulp of float", 0.51, float_ulps);
}

TEST(NumericsTriangles, weights_give_the_point_on_the_ray) {
  for (const AimKind& kind : std::span(aim_kinds).first(6)) {
    const std::string property =
        std::string("hit points (worst: in float's ulp) of rays ") + kind.name;
    expect_in_all_trials(property, 3, trials(200'000, 5'000'000), [&](Trial& trial) {
      const auto [ray, triangle] = kind.make(trial.random);
      const auto hit = intersect(ray, triangle);
      if (!hit) return;
      const auto say = [&, &aimed_ray = ray, &aimed_triangle = triangle] {
        return replay(aimed_ray, aimed_triangle);
      };
      trial.check(hit->u >= 0 && hit->v >= 0 && hit->u + hit->v <= 1, say);
      const Vec3d point = (1 - hit->u - hit->v) * Vec3d(triangle.v0) + hit->u * Vec3d(triangle.v1) +
                          hit->v * Vec3d(triangle.v2);
      const Vec3d on_ray = Vec3d(ray.origin) + hit->t * Vec3d(ray.direction);
      const double ulp = 0x1p-24 * (max_abs(on_ray) + max_abs(Vec3d(ray.origin)));
      trial.check(max_abs(point - on_ray) <= 0x1p-10 * ulp, say);
      trial.measure(max_abs(point - on_ray) / ulp);
    });
  }
}

/// A closed fan of 4 to 8 triangles around a vertex, all of which the ray meets from above.
struct Fan {
  Vec3f center;
  std::vector<Vec3f> rim;
  Vec3f towards_origin;

  TestTriangle triangle(size_t i) const {
    const Vec3f corners[] = {center, rim[i], rim[(i + 1) % rim.size()]};
    return {corners[i % 3], corners[(i + 1) % 3], corners[(i + 2) % 3]};
  }
};

struct FanKind {
  const char* name;
  double size;
  double offset;
  double distance;
  double rise;                 // of the rim
  double slope;                // of the rays, away from the fan's axis
  double control_per_million;  // that leak at least in float, at edges
};
constexpr FanKind fan_kinds[] = {
    {"of size 1", 1, 0, 3, 0.2, 0.5, 1e4},
    {"of size 1 at 1e5", 1, 1e5, 3, 0.2, 0.5, 0},
    {"of size 1e-6", 1e-6, 0, 3, 0.2, 0.5, 1e4},
    {"of size 1e6", 1e6, 0, 3, 0.2, 0.5, 1e4},
    {"from 1e4 sizes away", 1, 0, 1e4, 0.2, 0.5, 1e4},
    {"at 3 degrees", 1, 0, 3, 0.005, 20, 1e4},
};

Fan random_fan(const FanKind& kind, RandomSource& random) {
  const RandomAxes axes(random);
  const Vec3d center = kind.offset * Vec3d(1, -0.7, 0.3) + kind.size * Vec3d(random.vector(-1, 1));
  Fan fan{Vec3f(center), {}, {}};
  const int corner_count = random.integer(4, 8);
  for (int i = 0; i < corner_count; ++i) {
    const double angle = (i + 0.5 * random.unit()) * 2 * 3.14159265 / corner_count;
    const Vec3d local(std::cos(angle), std::sin(angle), kind.rise * random.unit());
    fan.rim.push_back(Vec3f(center + kind.size * axes.along(local)));
  }
  const double turn = 6.2831853 * random.unit();
  const Vec3d away(kind.slope * std::cos(turn), kind.slope * std::sin(turn), 1);
  fan.towards_origin = Vec3f(kind.size * kind.distance * glm::normalize(axes.along(away)));
  return fan;
}

TEST(NumericsTriangles, no_ray_aimed_at_a_vertex_or_an_edge_of_a_closed_fan_leaks) {
  for (const FanKind& kind : fan_kinds) {
    for (const bool at_vertex : {true, false}) {
      const std::string property =
          std::string("leaks at ") + (at_vertex ? "vertices" : "edges") + " of fans " + kind.name;
      const Tally tally = run_trials(property, 4, trials(40'000, 8'000'000), [&](Trial& trial) {
        RandomSource& random = trial.random;
        const Fan fan = random_fan(kind, random);
        const Vec3f target =
            at_vertex ? fan.center : glm::mix(fan.center, fan.rim[0], 0.1f + 0.8f * random.unit());
        const Vec3f origin = fan.center + fan.towards_origin;
        Ray ray{.origin = origin, .direction = target - origin};
        if (trial.index % 2 == 0) ray.direction *= std::exp2(random.between(-20, 20));
        bool is_hit = false;
        bool is_hit_in_float = false;
        for (size_t i = 0; i < fan.rim.size(); ++i) {
          is_hit = is_hit || intersect(ray, fan.triangle(i));
          is_hit_in_float = is_hit_in_float || moeller_trumbore(ray, fan.triangle(i));
        }
        trial.check(is_hit, [&] {
          std::string text = literal(ray);
          for (size_t i = 0; i < fan.rim.size(); ++i) text += "; " + literal(fan.triangle(i));
          return text;
        });
        trial.check_control(is_hit_in_float);
      });
      expect_holds_and_control_fails(property, tally, at_vertex ? 1e4 : kind.control_per_million);
    }
  }
}

// As it stands in a test of another renderer, whose default loses some: rays at the diagonal of a
// quad turned by any angle.
TEST(NumericsTriangles, every_ray_at_the_diagonal_of_a_turned_quad_hits) {
  const std::string property = "holes along the diagonal of turned quads";
  const Tally tally = run_trials(property, 5, trials(2'000, 200'000), [](Trial& trial) {
    const RandomAxes axes(trial.random);
    const auto corner = [&](double x, double y) { return Vec3f(axes.along({x, y, 0})); };
    const TestTriangle halves[] = {{corner(-1, -1), corner(1, -1), corner(1, 1)},
                                   {corner(-1, -1), corner(1, 1), corner(-1, 1)}};
    const Vec3f origin(axes.along({0.3, -0.2, 5}));
    for (int i = 0; i < 32; ++i) {
      const Vec3f target =
          glm::mix(halves[0].v0, halves[0].v2, (static_cast<float>(i) + 0.5f) / 32);
      const Ray ray{.origin = origin, .direction = target - origin};
      trial.check(intersect(ray, halves[0]) || intersect(ray, halves[1]),
                  [&] { return replay(ray, halves[0]) + "; " + literal(halves[1]); });
      trial.check_control(moeller_trumbore(ray, halves[0]) || moeller_trumbore(ray, halves[1]));
    }
  });
  expect_holds_and_control_fails(property, tally, 1e3);
}

TEST(NumericsTriangles, without_area_or_not_finite_are_never_hit) {
  constexpr float bad_values[] = {std::numeric_limits<float>::quiet_NaN(),
                                  std::numeric_limits<float>::infinity(),
                                  -std::numeric_limits<float>::infinity()};
  expect_in_all_trials("degenerate triangles", 6, trials(500'000, 20'000'000), [&](Trial& trial) {
    RandomSource& random = trial.random;
    TestTriangle t = any_triangle(random);
    const Ray ray = ray_to(glm::mix(t.v0, t.v1, random.unit()), 3, random);
    switch (random.integer(0, 3)) {
      case 0:
        t.v2 = random.integer(0, 1) == 0 ? t.v0 : t.v1;
        break;
      case 1:  // In a line, exactly.
        t.v0 = random.lattice(-1000, 1000);
        t.v1 = t.v0 + random.lattice(-50, 50);
        t.v2 = t.v0 + static_cast<float>(random.integer(-9, 9)) * (t.v1 - t.v0);
        break;
      case 2:
        t.v1[random.integer(0, 2)] = bad_values[random.integer(0, 2)];
        break;
      default:
        t.v0 = t.v1 = t.v2;
    }
    trial.check(!intersect(ray, t), [&] { return replay(ray, t); });
  });
}

TEST(NumericsTriangles, rays_in_the_plane_miss_on_either_side) {
  expect_in_all_trials("rays in the plane", 7, trials(500'000, 20'000'000), [](Trial& trial) {
    RandomSource& random = trial.random;
    const Vec3f corner = random.lattice(-100, 100);
    const Vec3f side = random.lattice(-20, 20);
    const Vec3f other = random.lattice(-20, 20);
    const auto in_plane = [&] {
      return static_cast<float>(random.integer(-9, 9)) * side +
             static_cast<float>(random.integer(-9, 9)) * other;
    };
    const Ray ray{.origin = corner + in_plane(), .direction = in_plane()};
    if (ray.direction == Vec3f(0)) return;
    const TestTriangle front{corner, corner + side, corner + other};
    const TestTriangle back{front.v0, front.v2, front.v1};
    trial.check(!intersect(ray, front) && !intersect(ray, back),
                [&] { return replay(ray, front); });
  });
}

TEST(NumericsTriangles,
     the_order_of_vertices_changes_no_verdict_and_t_by_less_than_2_to_the_minus_31) {
  for (const auto& [name, make_aim] : aim_kinds) {
    const std::string property = std::string("six orders of vertices, rays ") + name;
    expect_in_all_trials(property, 8, trials(50'000, 2'000'000), [&](Trial& trial) {
      const auto [ray, t] = make_aim(trial.random);
      const auto hit = intersect(ray, t);
      for (const TestTriangle& turned :
           {TestTriangle{t.v1, t.v2, t.v0}, TestTriangle{t.v2, t.v0, t.v1},
            TestTriangle{t.v0, t.v2, t.v1}, TestTriangle{t.v2, t.v1, t.v0},
            TestTriangle{t.v1, t.v0, t.v2}}) {
        const auto other = intersect(ray, turned);
        const bool is_same = hit.has_value() == other.has_value() &&
                             (!hit || std::abs(hit->t - other->t) <= 0x1p-31 * std::abs(hit->t));
        trial.check(is_same, [&] { return replay(ray, t) + " and " + literal(turned); });
      }
    });
  }
}

TEST(NumericsTriangles, scaled_by_a_power_of_two_have_the_same_bits) {
  for (const AimKind& kind : {aim_kinds[0], aim_kinds[1], aim_kinds[2], aim_kinds[3]}) {
    const std::string property = std::string("scaling by 2^k, rays ") + kind.name;
    expect_in_all_trials(property, 9, trials(50'000, 2'000'000), [&](Trial& trial) {
      const auto [ray, t] = kind.make(trial.random);
      const float scale = std::ldexp(1.0f, trial.random.integer(-40, 40));
      const Ray scaled_ray{.origin = scale * ray.origin, .direction = ray.direction};
      const TestTriangle scaled{scale * t.v0, scale * t.v1, scale * t.v2};
      const auto hit = intersect(ray, t);
      const auto scaled_hit = intersect(scaled_ray, scaled);
      bool is_same = hit.has_value() == scaled_hit.has_value();
      if (hit && scaled_hit) {
        is_same =
            hit->u == scaled_hit->u && hit->v == scaled_hit->v && scale * hit->t == scaled_hit->t;
      }
      trial.check(is_same, [&] { return replay(ray, t) + " and " + replay(scaled_ray, scaled); });
    });
  }
}

}  // namespace
}  // namespace tracer::stress
