// SPDX-License-Identifier: MIT
// Where a model stands and in which unit changes nothing that is seen.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/numerics/stress.h"
#include "tests/numerics/ways.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_meshes.h"
#include "tests/support/worlds.h"
#include "tracer/obj/make_mesh.h"
#include "tracer/obj/parse_obj.h"
#include "tracer/scene/import_obj.h"

namespace tracer::stress {
namespace {

const Vec3d survey_offset(500000, 4649776, 120);

std::string with_six_decimals(int64_t millionths) {
  const std::string digits = fmt::format("{:07}", std::abs(millionths));
  return fmt::format("{}{}.{}", millionths < 0 ? "-" : "", digits.substr(0, digits.size() - 6),
                     digits.substr(digits.size() - 6));
}

// The control rounds to float before it subtracts.
TEST(NumericsPlaceAndScale, positions_are_within_half_a_unit_of_the_text_after_recentring) {
  const std::string property = "recentred positions of models at survey coordinates (worst: error)";
  const auto model_count = trials(50, 2'000);
  const Tally tally = run_trials(property, 1, model_count, [](Trial& trial) {
    RandomSource& random = trial.random;
    std::vector<std::array<int64_t, 3>> vertices(3000);
    std::string text;
    for (auto& vertex : vertices) {
      for (size_t axis = 0; axis < 3; ++axis) {
        const double offset = survey_offset[static_cast<int>(axis)] * 1e6;
        vertex[axis] = static_cast<int64_t>(offset) + random.integer(-50'000'000, 50'000'000);
      }
      text += fmt::format("v {} {} {}\n", with_six_decimals(vertex[0]),
                          with_six_decimals(vertex[1]), with_six_decimals(vertex[2]));
    }
    for (size_t i = 0; i < vertices.size(); i += 3) {
      text += fmt::format("f {} {} {}\n", i + 1, i + 2, i + 3);
    }
    Progress progress;
    ObjFile file = parse_obj(text, "test.obj", progress);
    const Mesh mesh = make_mesh(file, "test.obj", progress).mesh;
    for (size_t i = 0; i < vertices.size(); ++i) {
      for (size_t axis = 0; axis < 3; ++axis) {
        const int a = static_cast<int>(axis);
        const long double exact =
            static_cast<long double>(vertices[i][axis]) / 1e6L - mesh.origin[a];
        const auto nearest = static_cast<float>(exact);
        const float ulp = std::nextafter(std::abs(nearest), 1e30f) - std::abs(nearest);
        // The text is a double first: half its last place at 4649776.
        const long double most = 0.5L * ulp + 0x1p-31L;
        const auto error = static_cast<double>(std::abs(mesh.positions[i][a] - exact));
        trial.check(error <= most, [&] { return with_six_decimals(vertices[i][axis]); });
        trial.measure(error);
        const auto as_float = static_cast<float>(vertices[i][axis] * 1e-6);
        const float moved = as_float - static_cast<float>(mesh.origin[a]);
        trial.check_control(std::abs(moved - exact) <= most);
      }
    }
  });
  expect_holds_and_control_fails(property, tally, 1e5);
}

/// An OBJ of a rough ball and a floor whose coordinates, multiples of 2^-10, are exact in decimals
/// and in double at any offset.
std::string dyadic_obj(const Vec3d& offset) {
  Mesh mesh = rough_ball(10, 0.1f, 3);
  std::string text;
  for (const Vec3f& position : mesh.positions) {
    const Vec3d rounded = offset + Vec3d(glm::round(1024.0f * position)) / 1024.0;
    text += fmt::format("v {:.10f} {:.10f} {:.10f}\n", rounded.x, rounded.y, rounded.z);
  }
  for (const Vec3u& t : mesh.triangles) {
    text += fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
  }
  for (const Vec3d& corner : {Vec3d(-3, -1, -3), {3, -1, -3}, {3, -1, 3}, {-3, -1, 3}}) {
    const Vec3d place = offset + corner;
    text += fmt::format("v {:.10f} {:.10f} {:.10f}\n", place.x, place.y, place.z);
  }
  return text + "f -4 -1 -2 -3\n";
}

constexpr Vec2i size_px(64, 48);

World world_of(const Scene& scene, const Vec3d& offset) {
  World world{
      .scene = std::make_shared<const Scene>(scene), .accel = {}, .camera = {}, .sky = Vec3d(0.7)};
  world = in_production(world);
  test::set_camera(world, {.eye = offset + Vec3d(1.5, 1.25, 4), .target = offset}, size_px);
  return world;
}

void expect_same_pictures(const std::string& property, const World& world, const World& other) {
  const auto samples = static_cast<uint32_t>(trials(50, 1600) / 50 + 1);
  Tally tally;
  for (const Integrator& integrator : integrators()) {
    const Film film = test::render(world, integrator, {}, size_px, samples);
    const Film other_film = test::render(other, integrator, {}, size_px, samples);
    for (int i = 0; i < size_px.x * size_px.y; ++i) {
      const Vec2i pixel(i % size_px.x, i / size_px.x);
      Trial trial(2, static_cast<uint64_t>(i), tally);
      trial.check(film.mean(pixel.x, pixel.y) == other_film.mean(pixel.x, pixel.y), [&] {
        return fmt::format("{}, pixel {}, {}", integrator.name, pixel.x, pixel.y);
      });
    }
  }
  expect_holds(property, tally);
}

bool looks_alike(const World& world, const World& other) {
  const Integrator& normals = *find_integrator("normals");
  const Film film = test::render(world, normals, {}, size_px, 1);
  const Film other_film = test::render(other, normals, {}, size_px, 1);
  for (int i = 0; i < size_px.x * size_px.y; ++i) {
    const Vec2i pixel(i % size_px.x, i / size_px.x);
    if (film.mean(pixel.x, pixel.y) != other_film.mean(pixel.x, pixel.y)) return false;
  }
  return true;
}

// The control moves the vertices in float.
TEST(NumericsPlaceAndScale, a_model_in_survey_coordinates_has_the_picture_of_one_at_the_origin) {
  const TemporaryFolder folder;
  Progress progress;
  const auto import_at = [&](const Vec3d& offset) {
    return import_obj(folder.write("model.obj", dyadic_obj(offset)), progress).scene;
  };
  const Scene here = import_at(Vec3d(0));
  expect_same_pictures("pixels of a model at (500000, 4649776, 120)", world_of(here, Vec3d(0)),
                       world_of(import_at(survey_offset), survey_offset));

  Scene moved_in_float = here;
  Mesh mesh = moved(*here.mesh, Vec3f(survey_offset));
  mesh.materials = here.mesh->materials;
  moved_in_float.mesh = std::make_shared<const Mesh>(std::move(mesh));
  EXPECT_FALSE(looks_alike(world_of(here, Vec3d(0)), world_of(moved_in_float, survey_offset)));
}

/// Lit by the sky and by a lamp; every length a multiple of `unit`.
World lit_room(double unit) {
  test::Triangles triangles;
  triangles.add_quad({-3, -1, -3}, {0, 0, 6}, {6, 0, 0}, 0);
  triangles.add_quad({-3, -1, -3}, {6, 0, 0}, {0, 4, 0}, 0);
  triangles.add_quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, 1);
  triangles.add_sphere({0.2, 0, 0.3}, 1, 3, 2);
  for (Vec3f& position : triangles.mesh.positions) position *= static_cast<float>(unit);
  triangles.mesh.bounds = {static_cast<float>(unit) * triangles.mesh.bounds.min,
                           static_cast<float>(unit) * triangles.mesh.bounds.max};
  World world = in_production(
      test::make_world(triangles, {test::diffuse(0.7), test::diffuse(0.1, 4), test::diffuse(0.5)},
                       Vec3d(0.2, 0.3, 0.5)));
  test::set_camera(world, {.eye = unit * Vec3d(2, 1, 6), .target = unit * Vec3d(0, 0.3, 0)},
                   size_px);
  return world;
}

TEST(NumericsPlaceAndScale, a_scene_scaled_by_a_power_of_two_has_the_same_picture) {
  const World world = lit_room(1);
  for (const int exponent : {-60, -40, -37, -36, -20, -7, 1, 7, 20, 36, 37, 40, 60}) {
    expect_same_pictures(fmt::format("pixels of a scene of 2^{} its size", exponent), world,
                         lit_room(std::ldexp(1.0, exponent)));
  }
  EXPECT_FALSE(looks_alike(world, lit_room(0.7))) << "the control: 0.7 rounds";
}

}  // namespace
}  // namespace tracer::stress
