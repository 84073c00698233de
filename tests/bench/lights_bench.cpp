// SPDX-License-Identifier: MIT
// What a given error costs with one light and with thousands: seconds times squared error, which
// does not depend on how many samples are taken.
#include <random>

#include <benchmark/benchmark.h>

#include "tests/support/worlds.h"

namespace {

using namespace tracer;

constexpr Vec2i size_px{64, 64};

enum class Lamps { one, ceiling, cloud };

/// A hall of 16 by 16 by 6 with a ball in it; all lamps together have the same power.
World make_hall(Lamps lamps, int count) {
  test::Triangles hall;
  hall.add_box({-8, 0, -8}, {8, 6, 8}, 0);
  hall.add_sphere({0, 1.2, 0}, 1.2, 3, 0);
  const double area = 4.0 / count;  // of each; the one light is 2 by 2
  const auto side = static_cast<float>(std::sqrt(2 * area));
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1, 1);
  if (lamps == Lamps::one) hall.add_quad({-1, 5.9f, -1}, {2, 0, 0}, {0, 0, 2}, 1);
  const int row = static_cast<int>(std::sqrt(count));
  for (int i = 0; lamps == Lamps::ceiling && i < count; ++i) {
    const float step = 15.0f / static_cast<float>(row);
    const Vec3f corner(-7.5f + step * static_cast<float>(i % row), 5.9f,
                       -7.5f + step * static_cast<float>(i / row));
    hall.add(corner, corner + Vec3f(side, 0, 0), corner + Vec3f(0, 0, side), 1);
  }
  for (int i = 0; lamps == Lamps::cloud && i < count; ++i) {
    const Vec3f corner(7.5f * uniform(random), 4.5f + 1.3f * uniform(random),
                       7.5f * uniform(random));
    const Vec3f x(uniform(random), uniform(random), uniform(random));
    const Vec3f y(uniform(random), uniform(random), uniform(random));
    const Vec3f across = glm::normalize(glm::cross(x, y));
    hall.add(corner, corner + side * glm::normalize(x),
             corner + side * glm::cross(across, glm::normalize(x)), 1);
  }
  // The camera sees none of the lamps: their edges are noise of another kind.
  World world = test::make_world(hall, {test::diffuse(0.6), test::diffuse(0, 20)}, Vec3d(0));
  test::set_camera(world, {.eye = {6, 3, 7}, .target = {0, 0.2, 0}, .fov_degrees = 34}, size_px);
  return world;
}

/// Mean over the pixels of the samples' variance, by the squared mean of all.
double relative_variance(const World& world, int sample_count) {
  std::vector<double> sums(size_px.x * size_px.y), squares(sums.size());
  double total = 0;
  for (int seed = 0; seed < sample_count; ++seed) {
    const Film film =
        test::render(world, integrators().front(), {.bounces = 3, .seed = seed}, size_px, 1);
    for (size_t i = 0; i < sums.size(); ++i) {
      const double value = luminance(
          Vec3d(film.mean(static_cast<int>(i) % size_px.x, static_cast<int>(i) / size_px.x)));
      sums[i] += value;
      squares[i] += value * value;
      total += value;
    }
  }
  double variance = 0;
  for (size_t i = 0; i < sums.size(); ++i) {
    variance += (squares[i] - sums[i] * sums[i] / sample_count) / (sample_count - 1);
  }
  const double mean = total / (sample_count * static_cast<double>(sums.size()));
  return variance / static_cast<double>(sums.size()) / (mean * mean);
}

void time_to_error(benchmark::State& state, Lamps lamps) {
  const World world = make_hall(lamps, static_cast<int>(state.range(0)));
  const double variance = relative_variance(world, 256);
  int seed = 0;
  for (auto _ : state) {
    test::render(world, integrators().front(), {.bounces = 3, .seed = ++seed}, size_px, 1);
  }
  state.counters["variance"] = variance;
  // Seconds a pass times variance: seconds to a relative squared error of 1.
  state.counters["cost"] = benchmark::Counter(
      1 / variance, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(time_to_error, one_light, Lamps::one)->Arg(1);
BENCHMARK_CAPTURE(time_to_error, ceiling, Lamps::ceiling)->Arg(16)->Arg(256)->Arg(4096);
BENCHMARK_CAPTURE(time_to_error, cloud, Lamps::cloud)->Arg(16)->Arg(256)->Arg(4096);

}  // namespace
