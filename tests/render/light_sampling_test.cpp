// SPDX-License-Identifier: MIT
#include "tracer/render/light_sampling.h"

#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/light_statistics.h"
#include "tests/support/worlds.h"
#include "tracer/base/directions.h"
#include "tracer/render/path.h"
#include "tracer/scene/sun_sky.h"

namespace tracer {
namespace {

using test::diffuse;
using test::estimate;
using test::even_point;
using test::Triangles;

constexpr double pi = std::numbers::pi;

Surface surface_at_point(const Vec3d& position, const Vec3d& normal) {
  Surface surface{};
  surface.position = position;
  surface.geometric_normal = normal;
  surface.shading_normal = normal;
  return surface;
}

/// Irradiance of a polygon of radiance 1 that lies above the receiver's plane, nothing between
/// (Lambert's formula).
double irradiance_of_polygon(const std::vector<Vec3d>& corners, const Vec3d& position,
                             const Vec3d& normal) {
  double sum = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec3d a = glm::normalize(corners[i] - position);
    const Vec3d b = glm::normalize(corners[(i + 1) % corners.size()] - position);
    const Vec3d across = glm::cross(a, b);
    sum +=
        std::atan2(glm::length(across), glm::dot(a, b)) * glm::dot(glm::normalize(across), normal);
  }
  return std::abs(sum) / 2;
}

/// What the light sampler makes of it with `count` evenly spread numbers. `counts(sample)` tells
/// which samples are to be.
template <class Counts>
double sampled_irradiance(const Lights& lights, const Surface& surface, uint64_t count,
                          const Counts& counts) {
  double sum = 0;
  for (uint64_t i = 0; i < count; ++i) {
    const auto [u, v] = even_point<2>(i);
    const LightSample sample = lights.sample(surface, {u, v});
    const double cosine = glm::dot(sample.direction, surface.shading_normal);
    if (!(sample.pdf > 0 && cosine > 0 && counts(sample))) continue;
    sum += luminance(sample.radiance) * cosine / sample.pdf;
  }
  return sum / static_cast<double>(count);
}

bool all(const LightSample&) {
  return true;
}

TEST(LightSampling, a_rectangle_and_a_triangle_light_a_floor_as_lambert_says) {
  Triangles triangles;
  triangles.add_quad({-0.5f, 1, -0.3f}, {1.5f, 0, 0}, {0, 0.2f, 0.8f}, 0);
  const World rectangle = test::make_world(triangles, {diffuse(0, 1)}, Vec3d(0));
  Triangles other;
  other.add({0, 0.4f, 0}, {1, 1, 0.2f}, {0.1f, 0.8f, -1});
  const World triangle = test::make_world(other, {diffuse(0, 1)}, Vec3d(0));
  for (const Vec3d& position : {Vec3d(0), Vec3d(2, 0, 1), Vec3d(-0.4, 0.3, 0.1)}) {
    const Surface surface = surface_at_point(position, {0, 1, 0});
    const double by_rectangle = irradiance_of_polygon(
        {{-0.5, 1, -0.3}, {1, 1, -0.3}, {1, 1.2, 0.5}, {-0.5, 1.2, 0.5}}, position, {0, 1, 0});
    EXPECT_NEAR(sampled_irradiance(Lights(rectangle, {}), surface, 2'000'000, all) / by_rectangle,
                1, 1e-4);
    const double by_triangle =
        irradiance_of_polygon({{0, 0.4, 0}, {1, 1, 0.2}, {0.1, 0.8, -1}}, position, {0, 1, 0});
    EXPECT_NEAR(sampled_irradiance(Lights(triangle, {}), surface, 2'000'000, all) / by_triangle, 1,
                1e-4);
  }
}

const Vec3d ball_center(0.3, 2, -0.2);
constexpr double ball_radius = 0.5;

World ball(int level) {
  Triangles triangles;
  triangles.add_sphere(ball_center, ball_radius, level, 0);
  return test::make_world(triangles, {diffuse(0, 1)}, Vec3d(0));
}

/// Of the triangles that face the receiver, by Lambert's formula.
double irradiance_of_ball(const World& world, const Vec3d& position) {
  double sum = 0;
  for (const uint32_t light : world.scene->lights->triangles) {
    const Triangle t = triangle_at(*world.scene->mesh, light);
    if (glm::dot(t.area_normal(), position - t.v0) <= 0) continue;
    sum += irradiance_of_polygon({t.v0, t.v1, t.v2}, position, {0, 1, 0});
  }
  return sum;
}

TEST(LightSampling, a_ball_of_many_triangles_lights_a_floor_as_a_sphere_does) {
  const World coarse = ball(4), fine = ball(6), finest = ball(7);
  ASSERT_FALSE(coarse.scene->lights->tree.empty());
  for (const Vec3d& position : {Vec3d(0.3, 0, -0.2), Vec3d(1.5, 0, 0.4)}) {
    const Vec3d to_center = ball_center - position;
    const double distance = glm::length(to_center);
    const double sphere = pi * std::pow(ball_radius / distance, 2) * to_center.y / distance;
    // What a polyhedron lacks falls to a quarter a level.
    const double by_fine = irradiance_of_ball(fine, position);
    const double by_finest = irradiance_of_ball(finest, position);
    EXPECT_NEAR((by_finest + (by_finest - by_fine) / 3) / sphere, 1, 1e-4);

    // The halves that face away emit too, and nothing hides them here.
    const auto is_front = [&](const LightSample& sample) {
      const Triangle t = triangle_at(*coarse.scene->mesh, sample.triangle);
      return glm::dot(t.area_normal(), position - t.v0) > 0;
    };
    const double sampled = sampled_irradiance(
        Lights(coarse, {}), surface_at_point(position, {0, 1, 0}), 4'000'000, is_front);
    EXPECT_NEAR(sampled / irradiance_of_ball(coarse, position), 1, 1e-4);
  }
}

/// Part of what leaves one unit square that arrives at the other, by evenly spread points.
double form_factor(const Vec3f& corner, const Vec3f& side, const Vec3f& other_side,
                   uint64_t count) {
  Triangles triangles;
  triangles.add_quad(corner, side, other_side, 0);
  const World world = test::make_world(triangles, {diffuse(0, 1)}, Vec3d(0));
  const Lights lights(world, {});
  double sum = 0;
  for (uint64_t i = 0; i < count; ++i) {
    const auto [x, z, u, v] = even_point<4>(i);
    const Surface surface = surface_at_point({x, 0, z}, {0, 1, 0});
    const LightSample sample = lights.sample(surface, {u, v});
    const double cosine = sample.direction.y;
    if (sample.pdf > 0 && cosine > 0) sum += cosine / sample.pdf;
  }
  return sum / static_cast<double>(count) / pi;
}

TEST(LightSampling, opposite_unit_squares_have_their_form_factor) {
  const double expected = 2 / pi *
                          (std::log(std::sqrt(4.0 / 3)) +
                           2 * std::sqrt(2.0) * std::atan(1 / std::sqrt(2.0)) - 2 * std::atan(1.0));
  EXPECT_NEAR(form_factor({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 8'000'000), expected, 1e-4 * expected);
}

// Near their common edge each fills the other's sky: few points bring much.
TEST(LightSampling, unit_squares_at_a_right_angle_have_their_form_factor) {
  const double expected = 1 / pi *
                          (2 * std::atan(1.0) - std::sqrt(2.0) * std::atan(1 / std::sqrt(2.0)) +
                           0.25 * std::log(3.0 / 4));
  EXPECT_NEAR(form_factor({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 8'000'000), expected, 1e-2 * expected);
}

/// A map that is bright at one place.
std::shared_ptr<const Environment> spotted_environment() {
  LatLongImage image{32, 16, std::vector<Vec3f>(32 * 16, Vec3f(0.2f))};
  image.texels[4 * 32 + 9] = {80, 60, 30};
  return std::make_shared<const Environment>(SkyMap(std::move(image)));
}

std::vector<World> worlds_of_lights() {
  Triangles few;
  few.add_quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, 0);
  few.add({3, 1, 0}, {3, 2, 0}, {3, 1, 1}, 1);
  Triangles many;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-3, 3);
  for (int i = 0; i < 400; ++i) {
    const Vec3f corner(uniform(random), 3 + uniform(random), uniform(random));
    many.add(corner, corner + 0.1f * Vec3f(uniform(random), uniform(random), uniform(random)),
             corner + 0.1f * Vec3f(uniform(random), uniform(random), uniform(random)),
             static_cast<uint32_t>(i % 2));
  }
  const std::vector<Material> materials{diffuse(0, 2), diffuse(0, 30)};
  std::vector<World> worlds{
      test::make_world(few, materials, Vec3d(0)), test::make_world(many, materials, Vec3d(0)),
      test::make_world(few, materials, Vec3d(0)), test::make_world(many, materials, Vec3d(0))};
  worlds[2].environment = spotted_environment();
  worlds[3].environment = make_sun_sky({40, 30});
  worlds[3].zenith = {0, 0, 1};
  return worlds;
}

TEST(LightSampling, a_ray_that_finds_a_light_is_told_the_pdf_of_a_sample_that_does) {
  for (const World& world : worlds_of_lights()) {
    const Lights lights(world, {.sky_rotation = 70});
    for (uint64_t i = 0; i < 20'000; ++i) {
      const auto [u, v, x, y] = even_point<4>(i);
      const Surface surface =
          surface_at_point({4 * x - 2, 0.3, 4 * y - 2}, unit_or({x - 0.5, 1, y - 0.5}, {}));
      const LightSample sample = lights.sample(surface, {u, v});
      ASSERT_GT(sample.pdf, 0);
      double found;
      if (sample.triangle == no_primitive) {
        found = lights.sky_pdf(sample.direction);
      } else {
        const Triangle triangle = triangle_at(*world.scene->mesh, sample.triangle);
        const Vec3d normal = triangle.area_normal();
        const double distance =
            glm::dot(triangle.v0 - surface.position, normal) / glm::dot(sample.direction, normal);
        const Ray ray{.origin = offset_origin(surface), .direction = Vec3f(sample.direction)};
        found = lights.pdf(receiver_of(surface), sample.triangle, ray, distance);
      }
      // The ray's direction is rounded to float, which edge-on lights feel.
      ASSERT_NEAR(found / sample.pdf, 1, 1e-2) << i;
    }
  }
}

TEST(LightSampling, samples_of_all_lights_together_integrate_to_their_solid_angle) {
  // The mean of 1 / pdf over directions that can be sampled, by the share of triangles alone.
  for (const World& world : worlds_of_lights()) {
    const Lights lights(world, {});
    const Surface surface = surface_at_point({0.2, 0, -0.1}, {0, 1, 0});
    double expected = 0;
    for (const uint32_t light : world.scene->lights->triangles) {
      const Triangle t = triangle_at(*world.scene->mesh, light);
      const double above = std::min({t.v0.y, t.v1.y, t.v2.y});
      if (above > 0) {
        expected += irradiance_of_polygon({t.v0, t.v1, t.v2}, surface.position, {0, 1, 0}) *
                    luminance(Vec3d(
                        (*world.scene->materials)[world.scene->mesh->material_of(light)].emission));
      }
    }
    const auto is_above = [&](const LightSample& sample) {
      if (sample.triangle == no_primitive) return false;
      const Triangle t = triangle_at(*world.scene->mesh, sample.triangle);
      return std::min({t.v0.y, t.v1.y, t.v2.y}) > 0;
    };
    EXPECT_NEAR(sampled_irradiance(lights, surface, 2'000'000, is_above) / expected, 1, 2e-3);
  }
}

template <LightStrategy strategy>
void radiance_by(const World& world, RayCaster& rays, const RenderSettings& settings,
                 const SampleBlock& block) {
  NoRecorder recorder;
  BasicPath<strategy>::radiance(world, rays, settings, block, recorder);
}
const Integrator combined{"", "", "", radiance_by<LightStrategy::combined>, nullptr};
const Integrator by_lights{"", "", "", radiance_by<LightStrategy::light_sampling>, nullptr};
const Integrator by_scattering{"", "", "", radiance_by<LightStrategy::scattering>, nullptr};

/// How many standard errors lie between two means (the test of Welch).
double welch(const test::Estimate& a, const test::Estimate& b) {
  return std::abs(a.mean - b.mean) / std::hypot(a.standard_error, b.standard_error);
}

/// A floor and a ball below lights, looked at from the side.
World lit_ball(size_t which) {
  Triangles triangles;
  triangles.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 0);
  triangles.add_sphere({0, 0.8, 0}, 0.8, 2, 0);
  if (which != 1) triangles.add_quad({-1, 3, -1}, {1, 0, 0}, {0, 0, 1}, 1);
  for (int i = 0; which == 2 && i < 200; ++i) {
    const Vec3f corner(static_cast<float>(i % 20) * 0.4f - 4, 2.5f, static_cast<float>(i / 20));
    triangles.add(corner, corner + Vec3f(0.2f, 0, 0), corner + Vec3f(0, 0.1f, 0.2f), 1);
  }
  World world = test::make_world(triangles, {diffuse(0.7), diffuse(0.3, 5)}, Vec3d(0.1));
  if (which < 2) world.environment = spotted_environment();
  if (which == 3) world.environment = make_sun_sky({50, 120});
  test::set_camera(world, {.eye = {3, 2, 4}, .target = {0.9, 0.3, 0.5}, .fov_degrees = 25}, {1, 1});
  return world;
}

TEST(LightSampling, all_ways_of_finding_many_lights_maps_and_the_sun_agree) {
  const RenderSettings settings{.bounces = 3, .sky_strength = 1.5, .sky_rotation = 33};
  for (size_t which = 0; which < 4; ++which) {
    const World world = lit_ball(which);
    const test::Estimate mixed = estimate(world, combined, settings, 60'000);
    EXPECT_LT(welch(mixed, estimate(world, by_lights, settings, 60'000)), 4) << which;
    // The sun is all but never found by chance.
    if (which < 3) {
      EXPECT_LT(welch(mixed, estimate(world, by_scattering, settings, 300'000)), 4) << which;
    }
    RenderSettings brighter = settings;
    brighter.sky_strength = 1.6;
    if (which < 2) {
      EXPECT_GT(welch(mixed, estimate(world, combined, brighter, 60'000)), 4) << "the control";
    }
  }
}

TEST(LightSampling, turning_the_map_turns_the_picture_and_zenith_is_where_the_world_says) {
  Triangles nothing;
  nothing.add({0, -100, 0}, {1e-3f, -100, 0}, {0, -100, 1e-3f});
  World world = test::make_world(nothing, {diffuse(0)}, Vec3d(0));
  world.environment = spotted_environment();
  // The bright texel's direction: row 4 of 16, column 9 of 32.
  const double descent = pi * 4.5 / 16, azimuth = 2 * pi * (9.5 / 32 - 0.5);
  const Vec3d spot(std::sin(descent) * std::cos(azimuth), std::cos(descent),
                   std::sin(descent) * std::sin(azimuth));
  EXPECT_NEAR(Sky(world, {}).radiance(spot).x, 80, 1e-3);
  // Counter-clockwise as seen from above: +x goes to -z.
  const Vec3d turned(spot.z, spot.y, -spot.x);
  EXPECT_NEAR(Sky(world, {.sky_rotation = 90}).radiance(turned).x, 80, 1e-3);
  EXPECT_NEAR(Sky(world, {.sky_strength = 0.5}).radiance(spot).x, 40, 1e-3);
  world.zenith = {0, 0, 1};
  EXPECT_NEAR(Sky(world, {}).radiance({spot.x, -spot.z, spot.y}).x, 80, 1e-3);
  world.zenith = {0, -1, 0};
  EXPECT_NEAR(Sky(world, {}).radiance({spot.x, -spot.y, -spot.z}).x, 80, 1e-3);
}

TEST(LightSampling, clamping_cuts_indirect_light_alone) {
  const World world = lit_ball(0);
  const RenderSettings unclamped{.bounces = 3};
  RenderSettings clamped = unclamped;
  clamped.clamp = 0.05;
  EXPECT_GT(estimate(world, combined, unclamped, 20'000).mean,
            1.01 * estimate(world, combined, clamped, 20'000).mean);
  const auto direct = [&](RenderSettings settings) {
    settings.bounces = 1;
    return estimate(world, combined, settings, 2'000).mean;
  };
  EXPECT_EQ(direct(unclamped), direct(clamped));
}

}  // namespace
}  // namespace tracer
