// SPDX-License-Identifier: MIT
#include "tracer/render/render.h"

#include <chrono>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "tests/support/worlds.h"
#include "tracer/base/parallel.h"

namespace tracer {
namespace {

using test::diffuse;
using test::Triangles;

constexpr Vec2i size_px(150, 70);

World make_room(test::Tracing tracing = test::Tracing::tree, int ball_level = 2) {
  return test::make_room(size_px, tracing, ball_level);
}

void expect_same_bits(const Film& a, const Film& b) {
  for (int y = 0; y < a.size_px().y; ++y) {
    for (int x = 0; x < a.size_px().x; ++x) {
      ASSERT_EQ(a.sample_count(x, y), b.sample_count(x, y)) << x << ' ' << y;
      ASSERT_EQ(a.mean(x, y), b.mean(x, y)) << x << ' ' << y;
    }
  }
}

TEST(Render, films_have_the_same_bits_at_1_2_and_7_threads) {
  const World world = make_room();
  for (const Integrator& integrator : integrators()) {
    const Film expected =
        with_thread_count(1, [&] { return test::render(world, integrator, {}, size_px, 3); });
    for (const int threads : {2, 7}) {
      const Film film = with_thread_count(
          threads, [&] { return test::render(world, integrator, {}, size_px, 3); });
      expect_same_bits(film, expected);
    }
  }
}

TEST(Render, brute_force_and_tree_give_the_same_picture) {
  const World with_tree = make_room();
  const World without = make_room(test::Tracing::brute_force);
  for (const Integrator& integrator : integrators()) {
    expect_same_bits(test::render(with_tree, integrator, {}, size_px, 2),
                     test::render(without, integrator, {}, size_px, 2));
  }
}

TEST(Render, coarse_first_passes_add_up_to_the_same_film_as_one) {
  const World world = make_room();
  const Integrator& path = integrators().front();
  const StopFlag never;
  Film one_go(size_px);
  const PassStats whole = render_pass(world, path, {}, {0, 1}, one_go, never);
  Film coarse_first(size_px);
  uint64_t samples = 0;
  uint64_t rays = 0;
  for (Pass pass = first_pass; pass.sample == 0; pass = next_pass(pass)) {
    const PassStats stats = render_pass(world, path, {}, pass, coarse_first, never);
    EXPECT_TRUE(stats.is_complete);
    samples += stats.samples;
    rays += stats.rays;
  }
  expect_same_bits(coarse_first, one_go);
  EXPECT_EQ(samples, static_cast<uint64_t>(size_px.x * size_px.y));
  EXPECT_EQ(samples, whole.samples);
  EXPECT_EQ(rays, whole.rays);
}

TEST(Render, stopped_passes_resume_to_the_same_film) {
  const World world = make_room();
  const Integrator& path = integrators().front();
  const Film expected = test::render(world, path, {}, size_px, 3);
  Film film(size_px);
  int stops = 0;
  for (Pass pass = first_pass; pass.sample < 3;) {
    StopFlag stop;
    int tiles = 0;
    std::mutex mutex;
    const auto stop_now_and_then = [&](const Tile&) {
      const std::scoped_lock lock(mutex);
      if (++tiles == 1 + stops % 3) stop.request();
    };
    const PassStats stats = render_pass(world, path, {}, pass, film, stop, stop_now_and_then);
    if (stats.is_complete) pass = next_pass(pass);
    if (stop.requested()) ++stops;
  }
  EXPECT_GT(stops, 5);
  expect_same_bits(film, expected);
}

TEST(Render, no_sample_is_kept_from_a_ray_that_was_stopped) {
  // Stopping at any moment leaves pixels empty or right, never misses painted as sky.
  const World world = make_room(test::Tracing::brute_force, 4);
  const Integrator& path = integrators().front();
  const Film expected = test::render(world, path, {}, size_px, 1);
  for (int i = 1; i < 12; ++i) {
    Film film(size_px);
    StopFlag stop;
    std::thread stopper([&] {
      std::this_thread::sleep_for(std::chrono::microseconds(317 * i));
      stop.request();
    });
    render_pass(world, path, {}, {0, 1}, film, stop);
    stopper.join();
    for (int y = 0; y < size_px.y; ++y) {
      for (int x = 0; x < size_px.x; ++x) {
        if (film.sample_count(x, y) == 0) continue;
        ASSERT_EQ(film.mean(x, y), expected.mean(x, y));
      }
    }
  }
}

// From the request to the end of a pass in flight: some 0.1 ms on an idle machine; a loaded one may
// take a time slice or two.
double seconds_to_stop(const World& world) {
  Film film(size_px);
  StopFlag stop;
  std::chrono::steady_clock::time_point requested;
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    requested = std::chrono::steady_clock::now();
    stop.request();
  });
  const PassStats stats = render_pass(world, integrators().front(), {}, {0, 1}, film, stop);
  const auto returned = std::chrono::steady_clock::now();
  stopper.join();
  EXPECT_FALSE(stats.is_complete);
  return std::chrono::duration<double>(returned - requested).count();
}

TEST(Render, stops_within_milliseconds_even_when_each_ray_meets_every_triangle) {
  const World world = make_room(test::Tracing::brute_force, 7);
  ASSERT_GT(world.scene->mesh->triangle_count(), 100'000u);
  EXPECT_LT(seconds_to_stop(world), 0.1);
}

TEST(Render, stops_within_milliseconds_when_one_leaf_holds_every_triangle) {
  World world = make_room(test::Tracing::brute_force, 7);
  Progress progress;
  BvhTree tree = builders().front().build(primitive_boxes(*world.scene->mesh),
                                          {.max_depth = 1, .leaf_size = 64}, progress);
  world.accel = std::make_shared<const Accel>(
      make_accel(world.scene->mesh, std::move(tree), layouts().front(), progress));
  EXPECT_LT(seconds_to_stop(world), 0.1);
}

TEST(Render, a_pass_that_is_already_stopped_traces_nothing) {
  StopFlag stop;
  stop.request();
  Film film(size_px);
  const PassStats stats =
      render_pass(make_room(), integrators().front(), {}, first_pass, film, stop);
  EXPECT_FALSE(stats.is_complete);
  EXPECT_EQ(stats.samples, 0u);
  EXPECT_EQ(stats.rays, 0u);
}

TEST(Render, every_tile_is_reported_once_a_pass_after_the_film_holds_it) {
  Film film(size_px);
  std::vector<Tile> reported;
  std::mutex mutex;
  const StopFlag never;
  render_pass(make_room(), integrators().front(), {}, {0, 1}, film, never, [&](const Tile& tile) {
    const std::scoped_lock lock(mutex);
    EXPECT_EQ(film.sample_count(tile.x1 - 1, tile.y1 - 1), 1u);
    reported.push_back(tile);
  });
  EXPECT_EQ(reported.size(), make_tiles(size_px).size());
}

TEST(Render, samples_that_are_not_finite_are_black_and_counted) {
  const Integrator broken{
      "", "", "",
      [](const World&, RayCaster&, const RenderSettings&, const SampleBlock& block) {
        for (size_t i = 0; i < block.size(); ++i) {
          const Vec3f direction = block.camera_rays[i].direction;
          block.radiance[i] =
              Vec3d(direction.x > 0 ? 1.0 : NAN, INFINITY, 0) * (direction.y > 0 ? 0.0 : 1.0);
        }
      },
      nullptr};
  Film film(size_px);
  const StopFlag never;
  const PassStats stats = render_pass(make_room(), broken, {}, {0, 1}, film, never);
  EXPECT_EQ(stats.dropped, stats.samples);
  for (int x = 0; x < size_px.x; ++x) EXPECT_EQ(film.mean(x, 30), Vec3f(0));
}

TEST(Render, seeds_give_different_noise) {
  const World world = make_room();
  const Integrator& path = integrators().front();
  const Film a = test::render(world, path, {.seed = 0}, size_px, 1);
  const Film b = test::render(world, path, {.seed = 1}, size_px, 1);
  int equal = 0;
  for (int x = 0; x < size_px.x; ++x) equal += a.mean(x, 60) == b.mean(x, 60) ? 1 : 0;
  EXPECT_LT(equal, size_px.x / 2);
}

TEST(DescribeSample, ends_with_the_radiance_that_rendering_computes) {
  const World world = make_room();
  const StopFlag never;
  RayCaster rays(*world.accel, never);
  for (const Integrator& integrator : integrators()) {
    for (int x = 0; x < size_px.x; x += 13) {
      const Vec2i pixel(x, 35);
      const Vec3d radiance = render_sample(world, integrator, {}, pixel, 2, rays);
      const std::string text = describe_sample(world, integrator, {}, pixel, 2);
      ASSERT_EQ(text.rfind("0  camera  ", 0), 0u) << text;
      const size_t last_line = text.rfind("\nradiance ");
      ASSERT_NE(last_line, std::string::npos) << text;
      double r = 0, g = 0, b = 0;
      ASSERT_EQ(std::sscanf(text.c_str() + last_line, " radiance %lf %lf %lf", &r, &g, &b), 3);
      ASSERT_LE(max_abs(Vec3d(r, g, b) - radiance), 1e-8 * max_abs(radiance)) << text;
    }
  }
}

TEST(Integrators, have_distinct_names_and_path_is_the_default) {
  EXPECT_EQ(integrators().front().name, "path");
  for (const char* name : {"path", "eyelight", "normals", "ao"}) {
    ASSERT_NE(find_integrator(name), nullptr) << name;
    EXPECT_EQ(find_integrator(name)->name, name);
  }
  EXPECT_EQ(find_integrator("none"), nullptr);
}

TEST(Integrators, previews_show_normals_albedo_and_openness) {
  Triangles triangles;
  triangles.add_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  World world = test::make_world(triangles, {diffuse(0.25)}, Vec3d(0.5, 0.6, 0.7));
  test::set_camera(world, {.eye = {0, 0, 3}, .fov_degrees = 1e-3}, {1, 1});
  const StopFlag never;
  RayCaster rays(*world.accel, never);
  const auto sample = [&](const char* name) {
    return render_sample(world, *find_integrator(name), {}, {0, 0}, 0, rays);
  };
  EXPECT_EQ(sample("normals"), Vec3d(0.5, 0.5, 1));
  EXPECT_NEAR(sample("eyelight").x, 0.25, 1e-9);
  EXPECT_EQ(sample("ao"), Vec3d(1));

  test::set_camera(world, {.eye = {0, 0, 3}, .target = {0, 0, 9}}, {1, 1});
  EXPECT_EQ(sample("normals"), Vec3d(0));
  EXPECT_EQ(sample("eyelight"), world.sky);
  EXPECT_EQ(sample("ao"), Vec3d(1));
}

TEST(Integrators, half_of_a_corner_is_occluded_as_its_form_factor_says) {
  // A wide wall on a wide floor takes half of the light from the foot of the wall.
  Triangles triangles;
  triangles.add_quad({-100, 0, 0}, {0, 0, 100}, {200, 0, 0});
  triangles.add_quad({-100, 0, 0}, {200, 0, 0}, {0, 100, 0});
  World world = test::make_world(triangles, {diffuse(0.5)}, Vec3d(1));
  test::set_camera(world, {.eye = {0, 1, 1}, .target = {0, 0, 1e-3}, .fov_degrees = 1e-4}, {1, 1});
  const test::Estimate open = test::estimate(world, *find_integrator("ao"), {}, 50'000);
  EXPECT_NEAR(open.mean, 0.5, 4 * open.standard_error + 1e-3);
}

}  // namespace
}  // namespace tracer
