// SPDX-License-Identifier: MIT
// The way from samples to bytes: sums, samples that are no numbers, sRGB codes.
#include "tracer/render/film.h"

#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/numerics/stress.h"
#include "tests/support/worlds.h"
#include "tracer/render/develop.h"

namespace tracer::stress {
namespace {

// A last sample takes away what the exact sum would be, so that the mean shows the error.
TEST(NumericsFilm, sums_of_a_hundred_million_samples_are_exact_to_1e_12) {
  const auto count = static_cast<uint32_t>(trials(100'000'000, 100'000'000));
  const double sample = 0.1f;
  Film film({1, 1});
  float float_sum = 0;
  for (uint32_t i = 0; i < count; ++i) {
    film.add(0, 0, Vec3d(sample));
    float_sum += 0.1f;
  }
  EXPECT_EQ(film.mean(0, 0).x, 0.1f);
  const double exact_sum = sample * count;
  film.add(0, 0, Vec3d(-exact_sum));
  const double error = std::abs(film.mean(0, 0).x * (count + 1.0)) / exact_sum;
  const double error_in_float = std::abs(static_cast<double>(float_sum) - exact_sum) / exact_sum;
  Tally tally;
  Trial trial(1, 0, tally);
  trial.check(error <= 1e-12, [&] { return "relative error " + std::to_string(error); });
  trial.check_control(error_in_float <= 1e-6);
  trial.measure(error);
  expect_holds_and_control_fails("mean of 1e8 samples (worst: relative error)", tally, 1e6);
}

// Under a sky that is no number, samples that end there are lost, and no others.
TEST(NumericsFilm, samples_that_are_not_finite_are_counted_as_black_and_spread_to_no_other) {
  test::Triangles triangles;
  triangles.add_sphere(Vec3d(0), 1, 2, 0);
  const Vec2i size_px(40, 30);
  World world = test::make_world(triangles, {test::diffuse(0, 1)}, Vec3d(0));
  test::set_camera(world, {.eye = {0, 0, 4}}, size_px);
  const Integrator& path = *find_integrator("path");
  const Film expected = test::render(world, path, {}, size_px, 1);
  const StopFlag never;
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    world.sky = Vec3d(0.5, bad, 0.5);
    Film film(size_px);
    const PassStats stats = render_pass(world, path, {}, {0, 1}, film, never);
    RayCaster rays(*world.accel, never);
    uint64_t not_finite = 0;
    std::optional<SampleId> first_not_finite;
    Tally tally;
    for (int y = 0; y < size_px.y; ++y) {
      for (int x = 0; x < size_px.x; ++x) {
        Trial trial(2, static_cast<uint64_t>(y * size_px.x + x), tally);
        trial.check(film.mean(x, y) == expected.mean(x, y) && film.sample_count(x, y) == 1,
                    [&] { return "pixel " + std::to_string(x) + ", " + std::to_string(y); });
        if (is_finite(render_sample(world, path, {}, {x, y}, 0, rays))) continue;
        if (not_finite++ == 0) first_not_finite = {{x, y}, 0};
      }
    }
    EXPECT_EQ(stats.dropped, not_finite);
    EXPECT_EQ(stats.first_dropped, first_not_finite);
    EXPECT_GT(stats.dropped, 100u);
    EXPECT_LT(stats.dropped, stats.samples - 100);
    expect_holds("pixels beside samples that are " + std::to_string(bad), tally);
  }
}

/// [IEC 61966-2-1], in long double.
int exact_code(float linear) {
  const long double x = linear;
  const long double encoded =
      x <= 0.0031308L ? 12.92L * x : 1.055L * std::pow(x, 1 / 2.4L) - 0.055L;
  return static_cast<int>(std::floor(255 * encoded + 0.5L));
}

/// The bits of the least float of a code, by the exact curve.
uint32_t first_bits_of_code(int code) {
  uint32_t below = 0;
  uint32_t at_least = std::bit_cast<uint32_t>(1.0f);
  while (at_least - below > 1) {
    const uint32_t middle = below + (at_least - below) / 2;
    (exact_code(std::bit_cast<float>(middle)) >= code ? at_least : below) = middle;
  }
  return at_least;
}

// The exact curve rises, so its 255 steps say what all floats between them are.
TEST(NumericsFilm, srgb_codes_of_all_floats_from_0_to_1_are_the_nearest) {
  const uint32_t one = std::bit_cast<uint32_t>(1.0f);
  // 1, but under a sanitizer some.
  const auto stride = static_cast<uint32_t>(101 / trials(101, 101));
  const std::string property = "sRGB codes of all floats in [0, 1)";
  expect_in_all_trials(property, 3, 256, [&](Trial& trial) {
    const int code = static_cast<int>(trial.index);
    const uint32_t begin = code == 0 ? 0 : first_bits_of_code(code);
    const uint32_t end = code == 255 ? one : first_bits_of_code(code + 1);
    for (uint32_t bits = begin; bits < end; bits += stride) {
      trial.check(encode_srgb(std::bit_cast<float>(bits)) == code,
                  [&] { return "encode_srgb(" + literal(std::bit_cast<float>(bits)) + ')'; });
    }
  });
}

TEST(NumericsFilm, srgb_codes_of_all_other_floats_are_0_or_255) {
  const std::string property = "sRGB codes of negative floats, floats from 1, infinities and NaN";
  constexpr uint64_t a_trial = 1u << 16;
  const uint32_t one = std::bit_cast<uint32_t>(1.0f);
  const uint64_t others = (uint64_t{1} << 32) - one;
  const uint64_t all = (others + a_trial - 1) / a_trial;
  const uint64_t count = trials(all / 16, all);
  expect_in_all_trials(property, 4, count, [&](Trial& trial) {
    // In the short form spread evenly.
    const uint64_t begin = one + trial.index * all / count * a_trial;
    for (uint64_t i = begin; i < std::min(begin + a_trial, uint64_t{1} << 32); ++i) {
      const auto value = std::bit_cast<float>(static_cast<uint32_t>(i));
      const int code = value >= 1 ? 255 : 0;
      trial.check(encode_srgb(value) == code,
                  [&] { return "encode_srgb(" + literal(value) + ')'; });
    }
  });
}

}  // namespace
}  // namespace tracer::stress
