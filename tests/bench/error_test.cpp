// SPDX-License-Identifier: MIT
// What errors are measured with: if this is wrong, every curve is.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/bench/compare/error_records.h"
#include "tests/bench/compare/flip.h"

namespace bench {
namespace {

using tracer::Image;
using tracer::Vec3f;

Image constant(float value, tracer::Vec2i size_px = {32, 32}) {
  return {size_px, std::vector<Vec3f>(static_cast<size_t>(size_px.x) * size_px.y, Vec3f(value))};
}

/// `value` and uniform noise of this deviation.
Image noisy(float value, double deviation, unsigned seed) {
  Image image = constant(value, {64, 64});
  std::mt19937 random(seed);
  const double half = std::sqrt(3.0) * deviation;
  std::uniform_real_distribution<double> noise(-half, half);
  for (Vec3f& pixel : image.pixels) {
    for (int channel = 0; channel < 3; ++channel) {
      pixel[channel] += static_cast<float>(noise(random));
    }
  }
  return image;
}

MeasuredSnapshot snapshot(int rung, double seconds, double relmse) {
  return {rung, seconds, seconds, {.relmse = relmse, .rmse = std::sqrt(relmse)}};
}

TEST(ErrorMeasures, of_a_picture_beside_one_without_noise_are_those_of_their_definitions) {
  const Reference reference{constant(0.5f), constant(0.5f), 1};
  const ErrorMeasures errors = measure_errors(constant(0.75f), reference);
  EXPECT_NEAR(errors.relmse, 0.0625 / 0.26, 1e-9);
  EXPECT_NEAR(errors.rmse, 0.25, 1e-9);
  EXPECT_NEAR(errors.mae, 0.25, 1e-9);
  EXPECT_EQ(measure_errors(constant(0.5f), reference).relmse, 0);
}

TEST(ErrorMeasures, noise_of_the_reference_adds_nothing_to_the_squares) {
  const Reference reference{noisy(0.5f, 0.1, 1), noisy(0.5f, 0.1, 2), 1};
  const ErrorMeasures errors = measure_errors(noisy(0.5f, 0.05, 3), reference);
  // A mean square of the difference from the halves' mean would be 0.0075.
  EXPECT_NEAR(errors.rmse * errors.rmse, 0.0025, 0.0004);
  EXPECT_NEAR(reference_relmse(reference), 0.005 / 0.26, 0.002);
}

TEST(ErrorMeasures, what_two_pictures_have_in_common_is_told_from_their_noise) {
  const Reference reference{noisy(0.5f, 0.01, 1), noisy(0.5f, 0.01, 2), 1};
  EXPECT_NEAR(systematic_relmse(noisy(0.5f, 0.1, 3), noisy(0.5f, 0.1, 4), reference), 0, 1e-3);
  EXPECT_NEAR(systematic_relmse(noisy(0.6f, 0.1, 3), noisy(0.6f, 0.1, 4), reference), 0.01 / 0.26,
              3e-3);
}

TEST(ErrorMeasures, pictures_of_different_sizes_are_refused) {
  const Reference reference{constant(0, {8, 8}), constant(0, {8, 8}), 1};
  EXPECT_THROW(measure_errors(constant(0, {8, 4}), reference), std::invalid_argument);
}

TEST(Flip, equal_pictures_do_not_differ_and_white_from_black_differs_as_published_formulas_say) {
  EXPECT_EQ(mean_flip(noisy(0.5f, 0.1, 1), noisy(0.5f, 0.1, 1)), 0);
  EXPECT_NEAR(mean_flip(constant(1), constant(0)), 0.967, 0.002);
  EXPECT_NEAR(mean_flip(constant(4), constant(1)), 0, 1e-6);  // as it is shown
}

TEST(Flip, grows_with_the_noise_and_lies_between_0_and_1) {
  double before = 0;
  for (const double deviation : {0.01, 0.03, 0.1, 0.3}) {
    const double flip = mean_flip(noisy(0.5f, deviation, 1), constant(0.5f, {64, 64}));
    EXPECT_GT(flip, before);
    EXPECT_LT(flip, 1);
    before = flip;
  }
}

TEST(ErrorCurves, an_interval_is_that_of_student) {
  const std::vector<double> values{1, 2, 3, 4};
  const Interval interval = interval_of(values);
  EXPECT_EQ(interval.mean, 2.5);
  EXPECT_NEAR(interval.high - interval.mean, 3.182 * std::sqrt(5.0 / 3 / 4), 1e-3);
  EXPECT_EQ(interval_of(std::vector<double>{7}).low, 7);
}

TEST(ErrorCurves, a_time_lies_on_the_line_between_rungs_and_beyond_them_is_marked) {
  std::vector<ErrorRung> rungs;
  for (const double seconds : {1.0, 2.0, 4.0, 8.0}) {
    rungs.push_back({.seconds = seconds, .relmse = {0.1 / seconds, 0, 1}});
  }
  const auto within = time_to(rungs, 0.1 / 3);
  ASSERT_TRUE(within);
  EXPECT_NEAR(within->seconds, 3, 1e-9);
  EXPECT_FALSE(within->is_extrapolated);
  const auto beyond = time_to(rungs, 1e-3);
  ASSERT_TRUE(beyond);
  EXPECT_NEAR(beyond->seconds, 100, 1e-6);
  EXPECT_TRUE(beyond->is_extrapolated);
  EXPECT_FALSE(time_to(std::span(rungs).first(1), 1e-3));
}

TEST(ErrorCurves, a_curve_is_of_the_rungs_that_all_seeds_have_less_what_is_systematic) {
  const std::vector<std::vector<MeasuredSnapshot>> seeds{
      {snapshot(0, 1, 0.12), snapshot(1, 2, 0.06), snapshot(3, 8, 0.02)},
      {snapshot(0, 1, 0.10), snapshot(1, 2, 0.06), snapshot(2, 4, 0.03), snapshot(3, 8, 0.02)}};
  const ErrorCurve curve = make_curve("scene", "tracer", seeds, 0.01);
  ASSERT_EQ(curve.rungs.size(), 3u);
  EXPECT_NEAR(curve.rungs[0].relmse.mean, 0.10, 1e-12);
  EXPECT_NEAR(curve.rungs[2].relmse.mean, 0.01, 1e-12);
  EXPECT_EQ(curve.seeds, 2);
  EXPECT_NEAR(curve.rmse_slope, -0.4, 0.1);
  ASSERT_FALSE(curve.times.empty());
  EXPECT_EQ(curve.times.front().relmse, 1e-2);
  EXPECT_NEAR(curve.times.front().seconds, 8, 1e-6);
  const nlohmann::json json = curve;
  EXPECT_EQ(json["rungs"].size(), 3u);
}

TEST(ErrorRuns, a_ladder_is_one_render_whose_pictures_take_longer_and_longer) {
  const ErrorSceneEntry& box = error_scene_entries().back();
  const auto scene = load_error_scene(box, 16);
  ASSERT_TRUE(scene);
  const std::vector<double> seconds{0.01, 0.02, 0.04};
  const std::vector<Snapshot> ladder = render_ladder(*scene, variants().front(), 1, seconds);
  ASSERT_FALSE(ladder.empty());
  double samples = 0;
  for (const Snapshot& picture : ladder) {
    EXPECT_GE(picture.seconds, seconds[picture.rung]);
    EXPECT_GT(picture.samples, samples);
    EXPECT_EQ(picture.image.size_px, scene->size_px);
    samples = picture.samples;
  }
}

TEST(ErrorRuns, every_variant_names_a_builder_that_there_is) {
  for (const Variant& variant : variants()) {
    if (variant.builder != nullptr) {
      EXPECT_NE(tracer::find_builder(variant.builder), nullptr) << variant.name;
    }
  }
}

}  // namespace
}  // namespace bench
