// SPDX-License-Identifier: MIT
// Secondary rays: what leaves a surface does not meet it again, and does not slip past its
// neighbour, at any size.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/numerics/rays.h"
#include "tests/numerics/stress.h"
#include "tests/numerics/ways.h"
#include "tests/support/test_meshes.h"
#include "tests/support/worlds.h"
#include "tracer/render/sampling.h"

namespace tracer::stress {
namespace {

using test::diffuse;
using test::Triangles;

std::vector<double> sizes() {
  std::vector<double> powers;
  for (int exponent = -6; exponent <= 6; ++exponent) powers.push_back(std::pow(10, exponent));
  return powers;
}

/// A closed convex body around `center`.
using MakeBody = Triangles (*)(const Vec3d& center, double size);

Triangles ball(const Vec3d& center, double size) {
  Triangles triangles;
  triangles.add_sphere(center, size, 1);
  return triangles;
}

// Each face is two triangles that rounding has put into slightly different planes.
Triangles turned_box(const Vec3d& center, double size) {
  RandomSource random(5);
  const RandomAxes axes(random);
  const auto corner = [&](const Vec3d& local) { return Vec3f(center + size * axes.along(local)); };
  const Vec3d half(1, 0.6, 0.3);
  Triangles triangles;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3d middle(0), u(0), v(0);
      middle[axis] = side * half[axis];
      // Right-handed about the outside.
      u[(axis + 1) % 3] = side * half[(axis + 1) % 3];
      v[(axis + 2) % 3] = half[(axis + 2) % 3];
      triangles.add(corner(middle - u - v), corner(middle + u - v), corner(middle + u + v));
      triangles.add(corner(middle - u - v), corner(middle + u + v), corner(middle - u + v));
    }
  }
  return triangles;
}

/// A hit by a ray from outside, at the inside or close to an edge or a vertex.
Hit random_hit(const Mesh& mesh, RandomSource& random) {
  const Vec2d weights = sample_triangle({random.unit(), random.unit()});
  const double closeness = random.integer(0, 2) == 0 ? std::exp2(random.between(-40, 0)) : 1;
  Hit hit{.t = 1, .u = weights.x, .v = weights.y, .primitive = random_triangle(mesh, random)};
  switch (random.integer(0, 2)) {
    case 0:
      hit.u *= closeness;
      break;
    case 1:
      hit.u *= closeness;
      hit.v *= closeness;
      break;
    default:
      hit.v = 1 - hit.u - closeness * (1 - hit.u - hit.v);
  }
  return hit;
}

/// Half of all directions are close to the horizon.
Vec3f direction_above(const Vec3d& normal, RandomSource& random) {
  Vec2d u(random.unit(), random.unit());
  if (random.integer(0, 1) == 0) u.x = 1 - 1e-6 * u.x;
  return Vec3f(sample_cosine_hemisphere(normal, u));
}

struct BodyKind {
  const char* name;
  MakeBody make;
};
constexpr BodyKind bodies[] = {{"balls", ball}, {"turned boxes", turned_box}};

// The control is the usual o + t d.
TEST(NumericsAcneAndLeaks, no_ray_that_leaves_a_convex_body_meets_it_again) {
  for (const auto& [name, make_body] : bodies) {
    for (const double offset : {0.0, 1e3, 1e5}) {
      const std::string property =
          fmt::format("acne on {} of 1e-6 to 1e6 at {} sizes", name, offset);
      Tally total;
      for (const double size : sizes()) {
        const Vec3d center = offset * size * Vec3d(1, -0.7, 0.3);
        const World world =
            in_production(test::make_world(make_body(center, size), {diffuse(1)}, Vec3d(1)));
        const Mesh& mesh = *world.scene->mesh;
        total.add(run_trials(property, 1, trials(4'000, 1'300'000), [&](Trial& trial) {
          RandomSource& random = trial.random;
          const StopFlag never;
          RayCaster rays(*world.accel, never);
          const Hit hit = random_hit(mesh, random);
          const Vec3d outward = triangle_at(mesh, hit.primitive).area_normal();
          const Surface surface = surface_at(*world.scene, hit, -outward);
          const Vec3f direction = direction_above(surface.geometric_normal, random);
          if (!(glm::dot(Vec3d(direction), surface.geometric_normal) > 0)) return;
          const Ray ray{.origin = offset_origin(surface), .direction = direction};
          trial.check(!rays.occluded(ray),
                      [&] { return fmt::format("size {}, {}", size, literal(ray)); });
          const Vec3f on_surface(triangle_at(mesh, hit.primitive).at(hit.u, hit.v));
          trial.check_control(!rays.occluded({.origin = on_surface, .direction = direction}));
        }));
      }
      expect_holds_and_control_fails(property, total, 1e5);
    }
  }
}

// Ambient occlusion of a convex body under an open sky is 1 wherever one looks.
TEST(NumericsAcneAndLeaks, a_convex_body_under_a_white_sky_has_no_dark_pixel) {
  const Vec2i size_px(64, 64);
  const auto samples = static_cast<uint32_t>(trials(50, 1000) / 25 + 1);
  for (const auto& [name, make_body] : bodies) {
    const std::string property = std::string("pixels of white ") + name + " of 1e-6 to 1e6";
    Tally tally;
    for (const double size : sizes()) {
      World world =
          in_production(test::make_world(make_body(Vec3d(0), size), {diffuse(1)}, Vec3d(1)));
      test::set_camera(world, {.eye = size * Vec3d(2, 1.5, 4)}, size_px);
      const Film film = test::render(world, *find_integrator("ao"), {}, size_px, samples);
      for (int i = 0; i < size_px.x * size_px.y; ++i) {
        Trial trial(2, static_cast<uint64_t>(i), tally);
        trial.check(film.mean(i % size_px.x, i / size_px.x) == Vec3f(1), [&] {
          return fmt::format("size {}, pixel {}, {}", size, i % size_px.x, i / size_px.x);
        });
      }
    }
    expect_holds(property, tally);
  }
}

Triangles triangles_of(const Mesh& mesh, float size, uint32_t first) {
  Triangles triangles;
  for (uint32_t i = first; i < mesh.triangle_count(); ++i) {
    const TestTriangle corners = triangle_of(mesh, i);
    triangles.add(size * corners.v0, size * corners.v1, size * corners.v2);
  }
  return triangles;
}

Triangles tetrahedron() {
  const Vec3f a(-1, -1, -1), b(1, 1, -1), c(1, -1, 1), d(-1, 1, 1);
  Triangles triangles;
  triangles.add(a, b, c);
  triangles.add(a, b, d);
  triangles.add(b, c, d);
  triangles.add(a, c, d);
  return triangles;
}

struct Enclosure {
  const char* name;
  Mesh mesh;
};
std::vector<Enclosure> enclosures() {
  return {{"rough balls", rough_ball(6, 0.1f, 1)},
          {"turned boxes", turned_box(Vec3d(0), 1).mesh},
          {"tetrahedra", tetrahedron().mesh}};
}

/// Paths of up to 32 bounces from the middle of a body of nearly white walls under a bright sky.
/// Every ray is a check; a pixel that is not black, a failure.
Tally light_inside(const Triangles& body, double size, uint32_t samples) {
  const Vec2i size_px(64, 64);
  World world = in_production(test::make_world(body, {diffuse(0.95)}, Vec3d(1e9)));
  test::set_camera(world, {.eye = size * Vec3d(0.05, 0.02, 0.1), .fov_degrees = 120}, size_px);
  const StopFlag never;
  Film film(size_px);
  Tally tally;
  for (Pass pass{0, 1}; pass.sample < samples; pass = next_pass(pass)) {
    tally.checks +=
        render_pass(world, *find_integrator("path"), {.bounces = 32}, pass, film, never).rays;
  }
  for (int i = 0; i < size_px.x * size_px.y; ++i) {
    if (film.mean(i % size_px.x, i / size_px.x) == Vec3f(0)) continue;
    ++tally.failures;
    tally.replays.push_back(
        fmt::format("size {}, pixel {}, {}", size, i % size_px.x, i / size_px.x));
  }
  return tally;
}

// The control is the same with one triangle taken out.
TEST(NumericsAcneAndLeaks, no_light_comes_into_a_closed_body) {
  const auto samples = static_cast<uint32_t>(trials(50, 4000) / 50 + 1);
  for (const auto& [name, mesh] : enclosures()) {
    const std::string property = std::string("rays inside closed ") + name + " of 1e-6 to 1e6";
    const ProgressLine progress(property, samples);
    Tally total;
    for (const double size : sizes()) {
      const auto scale = static_cast<float>(size);
      total.add(light_inside(triangles_of(mesh, scale, 0), size, samples));
      const Tally open = light_inside(triangles_of(mesh, scale, 1), size, 1);
      total.control_checks += 1;
      total.control_failures += open.failures > 0 ? 1 : 0;
    }
    expect_holds_and_control_fails(property, total, 1e6);
  }
}

// Two parallel planes a millionth of their size apart. The control moves the origin by a fixed
// 1e-4, as is often done.
TEST(NumericsAcneAndLeaks, a_roof_a_millionth_of_the_size_above_the_floor_is_found) {
  const std::string property = "roofs 1e-6 of the size above floors of 1e-6 to 1e6";
  Tally total;
  for (const double size : sizes()) {
    total.add(run_trials(property, 3, trials(200, 50'000), [&](Trial& trial) {
      RandomSource& random = trial.random;
      const RandomAxes axes(random);
      const double side = size / std::sqrt(2.0);
      Triangles planes;
      for (const double height : {0.0, 1e-6 * size}) {
        const double reach = height > 0 ? side : 0.5 * side;
        const auto corner = [&](double x, double y) {
          return Vec3f(axes.along({x * reach, y * reach, height}));
        };
        planes.add(corner(-1, -1), corner(1, -1), corner(1, 1));
        planes.add(corner(-1, -1), corner(1, 1), corner(-1, 1));
      }
      const World world = test::make_world(planes, {diffuse(1)}, Vec3d(1));
      const StopFlag never;
      RayCaster rays(*world.accel, never);
      for (int i = 0; i < 20; ++i) {
        Hit hit = random_hit(*world.scene->mesh, random);
        hit.primitive = static_cast<uint32_t>(random.integer(0, 1));
        const Surface surface = surface_at(*world.scene, hit, -axes.z);
        const Vec3f direction(sample_cosine_hemisphere(
            surface.geometric_normal, {0.99 * static_cast<double>(random.unit()), random.unit()}));
        const Ray ray{.origin = offset_origin(surface), .direction = direction};
        trial.check(rays.occluded(ray),
                    [&] { return fmt::format("size {}, {}", size, literal(ray)); });
        const Vec3f fixed(surface.position + 1e-4 * surface.geometric_normal);
        trial.check_control(rays.occluded({.origin = fixed, .direction = direction}));
      }
    }));
  }
  expect_holds_and_control_fails(property, total, 1e5);
}

}  // namespace
}  // namespace tracer::stress
