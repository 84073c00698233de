// SPDX-License-Identifier: MIT
// Random numbers and what is made of them, over all their values.
#include "tracer/render/sampling.h"

#include <numbers>

#include <gtest/gtest.h>

#include "tests/numerics/stress.h"
#include "tracer/base/trigonometry.h"
#include "tracer/render/sampler.h"

namespace tracer::stress {
namespace {

constexpr uint64_t unit_float_count = 1u << 24;
constexpr uint64_t a_chunk = 1u << 16;

// The usual product with 2^-32 rounds 128 words up to 1, which is the control.
TEST(NumericsSampling, uniform_numbers_of_all_words_are_below_1_and_of_equal_weight) {
  const std::string property = "uniform numbers of all 2^32 words";
  const uint64_t word_count = uint64_t{1} << 32;
  const uint64_t chunk_count = word_count / a_chunk;
  const Tally tally =
      run_trials(property, 1, trials(chunk_count / 16, chunk_count), [&](Trial& trial) {
        // In the short form the last of them, where the greatest words are.
        const uint64_t chunk = chunk_count - 1 - trial.index;
        for (uint64_t i = 0; i < a_chunk; ++i) {
          const auto word = static_cast<uint32_t>(chunk * a_chunk + i);
          const float unit = to_unit_float(word);
          trial.check(unit < 1 && 0x1p24f * unit == static_cast<float>(word / 256),
                      [&] { return "to_unit_float(" + std::to_string(word) + ')'; });
          trial.check_control(static_cast<float>(word) * 0x1p-32f < 1);
        }
      });
  expect_holds_and_control_fails(property, tally, 0.01);
  EXPECT_EQ(tally.control_failures, 128u);
}

TEST(NumericsSampling, cosines_and_sines_of_all_uniform_numbers_are_within_1e_15) {
  const std::string property = "cos and sin of all uniform numbers (worst: error)";
  expect_in_all_trials(
      property, 2, trials(unit_float_count / a_chunk / 4, unit_float_count / a_chunk),
      [](Trial& trial) {
        for (uint64_t i = 0; i < a_chunk; ++i) {
          const double turns = static_cast<double>(trial.index * a_chunk + i) * 0x1p-24;
          const CosSin found = cos_sin_of_turns(turns);
          const long double angle = 2 * std::numbers::pi_v<long double> * turns;
          const auto error = static_cast<double>(std::max(std::abs(found.cos - std::cos(angle)),
                                                          std::abs(found.sin - std::sin(angle))));
          trial.check(error <= 1e-15, [&] { return "turns " + std::to_string(turns); });
          trial.measure(error);
        }
      });
}

/// The ends of [0, 1) as often as what lies between.
double any_uniform(RandomSource& random) {
  switch (random.integer(0, 3)) {
    case 0:
      return 0;
    case 1:
      return 1 - 0x1p-24;
    default:
      return static_cast<double>(random.unit());
  }
}

TEST(NumericsSampling, directions_are_unit_length_and_never_below_the_surface) {
  const std::string property = "directions about any normal (worst: error of the length)";
  expect_in_all_trials(property, 3, trials(1'000'000, 200'000'000), [](Trial& trial) {
    RandomSource& random = trial.random;
    Vec3d normal(random.vector(-1, 1));
    if (random.integer(0, 3) == 0) normal[random.integer(0, 2)] *= 1e-9;
    if (normal == Vec3d(0)) normal.z = -1;
    normal = glm::normalize(normal);
    const Vec2d u(any_uniform(random), any_uniform(random));
    const Vec3d direction = sample_cosine_hemisphere(normal, u);
    const double error = std::abs(glm::length(direction) - 1);
    trial.check(error <= 1e-14 && glm::dot(direction, normal) > 0, [&] {
      return "normal " + literal(Vec3f(normal)) + ", u " + std::to_string(u.x) + ' ' +
             std::to_string(u.y);
    });
    trial.measure(error);
  });
}

TEST(NumericsSampling, points_of_triangles_stay_inside) {
  expect_in_all_trials(
      "weights of points of triangles", 4, trials(1'000'000, 200'000'000), [](Trial& trial) {
        const Vec2d u(any_uniform(trial.random), any_uniform(trial.random));
        const Vec2d weights = sample_triangle(u);
        trial.check(weights.x >= 0 && weights.y >= 0 && weights.x + weights.y <= 1,
                    [&] { return "u " + std::to_string(u.x) + ' ' + std::to_string(u.y); });
      });
}

}  // namespace
}  // namespace tracer::stress
