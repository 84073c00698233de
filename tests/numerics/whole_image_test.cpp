// SPDX-License-Identifier: MIT
// One picture, whatever computes it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/numerics/stress.h"
#include "tests/numerics/ways.h"
#include "tests/support/test_meshes.h"
#include "tests/support/worlds.h"
#include "tracer/base/parallel.h"

namespace tracer::stress {
namespace {

constexpr Vec2i size_px(70, 50);  // more than a tile, and no multiple of a block

test::Triangles room() {
  test::Triangles triangles;
  triangles.add_quad({-3, -1, -3}, {0, 0, 6}, {6, 0, 0}, 0);
  triangles.add_quad({-3, -1, -3}, {6, 0, 0}, {0, 4, 0}, 0);
  triangles.add_quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, 1);
  triangles.add_sphere({0.2, 0, 0.3}, 1, 2, 2);
  return triangles;
}

// What coincides and what lies in a plane of coordinates, where a tie could go either way.
test::Triangles coincident_quads() {
  test::Triangles triangles;
  const Mesh quads = lattice_quads(100, 5);
  for (const Vec3u& t : quads.triangles) {
    const uint32_t material = triangles.mesh.triangle_count() % 3;
    triangles.add(0.5f * quads.positions[t.x], 0.5f * quads.positions[t.y],
                  0.5f * quads.positions[t.z], material);
  }
  return triangles;
}

test::Triangles far_away() {
  test::Triangles triangles = room();
  for (Vec3f& position : triangles.mesh.positions) position += Vec3f(1000, -2000, 3000);
  for (Vec3f* corner : {&triangles.mesh.bounds.min, &triangles.mesh.bounds.max}) {
    *corner += Vec3f(1000, -2000, 3000);
  }
  return triangles;
}

struct Picture {
  const char* name;
  test::Triangles (*make)();
  Vec3d place;
};
constexpr Picture pictures[] = {{"a lit room", room, Vec3d(0)},
                                {"coincident quads", coincident_quads, Vec3d(0)},
                                {"a room far from the origin", far_away, Vec3d(1000, -2000, 3000)}};

World make_world(const Picture& picture) {
  World world = test::make_world(picture.make(),
                                 {test::diffuse(0.7), test::diffuse(0.1, 4), test::diffuse(0.5)},
                                 Vec3d(0.2, 0.3, 0.5), test::Tracing::brute_force);
  test::set_camera(
      world, {.eye = picture.place + Vec3d(2, 1, 6), .target = picture.place + Vec3d(0, 0.3, 0)},
      size_px);
  return world;
}

void check_same(Tally& tally, const Film& film, const Film& expected, const std::string& how) {
  for (int i = 0; i < size_px.x * size_px.y; ++i) {
    const Vec2i pixel(i % size_px.x, i / size_px.x);
    Trial trial(1, static_cast<uint64_t>(i), tally);
    trial.check(film.mean(pixel.x, pixel.y) == expected.mean(pixel.x, pixel.y),
                [&] { return fmt::format("{}, pixel {}, {}", how, pixel.x, pixel.y); });
  }
}

/// The settings of trees that are tried: all in the long form, some of them by default.
std::vector<BuildSettings> tree_settings() {
  if (!is_long()) return {{}, {64, 1}, {3, 64}};
  std::vector<BuildSettings> all;
  for (const int max_depth : {1, 5, 30, 64}) {
    for (const int leaf_size : {1, 4, 16, 64}) all.push_back({max_depth, leaf_size});
  }
  return all;
}

TEST(NumericsWholeImage, no_builder_layout_instruction_set_or_number_of_threads_changes_a_bit) {
  for (const Picture& picture : pictures) {
    const World world = make_world(picture);
    const Mesh& mesh = *world.scene->mesh;
    for (const Integrator& integrator : integrators()) {
      const std::string property =
          fmt::format("pixels of {}, {}, however traced", picture.name, integrator.name);
      const ProgressLine progress(property, 1);
      const auto samples = static_cast<uint32_t>(is_long() ? 4 : 1);
      const Film expected = test::render(world, integrator, {}, size_px, samples);
      Tally tally;
      for (const Builder& builder : builders()) {
        for (const BuildSettings& settings : tree_settings()) {
          const BvhTree tree = build_tree(builder, mesh, settings);
          for_each_accel(world.scene->mesh, tree, [&](const std::string& way, const Accel& accel) {
            World other = world;
            other.accel = std::make_shared<const Accel>(accel);
            for (const int threads : is_long() ? std::vector{1, 2, 3, 7} : std::vector{1, 7}) {
              const Film film = with_thread_count(
                  threads, [&] { return test::render(other, integrator, {}, size_px, samples); });
              check_same(tally, film, expected,
                         fmt::format("{}, depth {}, leaf size {}, {}, {} threads", builder.name,
                                     settings.max_depth, settings.leaf_size, way, threads));
            }
          });
        }
      }
      expect_holds(property, tally);
    }
  }
}

TEST(NumericsWholeImage, no_size_of_tiles_changes_a_bit) {
  const uint32_t samples = is_long() ? 4 : 2;
  const StopFlag never;
  for (const Picture& picture : pictures) {
    const World world = in_production(make_world(picture));
    for (const Integrator& integrator : integrators()) {
      const std::string property =
          fmt::format("pixels of {}, {}, in tiles of any size", picture.name, integrator.name);
      const ProgressLine progress(property, 1);
      const Film expected = test::render(world, integrator, {}, size_px, samples);
      Tally tally;
      // From a tile a pixel to one of all; 13 and 33 cut blocks and coarse grids anywhere.
      for (const int side_px : {1, 4, 13, 33, size_px.x}) {
        const std::vector<Tile> tiles = make_tiles(size_px, side_px);
        Film film(size_px);
        for (Pass pass = first_pass; pass.sample < samples; pass = next_pass(pass)) {
          render_tiles(world, integrator, {}, pass, tiles, film, never);
        }
        check_same(tally, film, expected, fmt::format("tiles of {} px", side_px));
      }
      expect_holds(property, tally);
    }
  }
}

// Else the tests above would hold for any picture.
TEST(NumericsWholeImage, another_seed_changes_bits) {
  const World world = in_production(make_world(pictures[0]));
  const Integrator& path = *find_integrator("path");
  Tally tally;
  check_same(tally, test::render(world, path, {.seed = 1}, size_px, 1),
             test::render(world, path, {}, size_px, 1), "seed 1");
  EXPECT_GT(tally.failures, tally.checks / 4);
}

}  // namespace
}  // namespace tracer::stress
