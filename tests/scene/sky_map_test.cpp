// SPDX-License-Identifier: MIT
#include "tracer/scene/sky_map.h"

#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/light_statistics.h"
#include "tracer/base/directions.h"

namespace tracer {
namespace {

LatLongImage constant_image(int width, int height, const Vec3f& radiance) {
  return {width, height, std::vector<Vec3f>(static_cast<size_t>(width) * height, radiance)};
}

/// Bright at one place, black at others, grey else.
LatLongImage spotted_image() {
  LatLongImage image = constant_image(32, 16, Vec3f(0.1f));
  for (int column = 10; column < 20; ++column) {
    for (int row = 6; row < 12; ++row) image.texels[row * 32 + column] = Vec3f(0);
  }
  image.texels[3 * 32 + 5] = {50, 40, 20};
  return image;
}

/// A direction in cell (column, row) of a grid over azimuth and height, at a place in [0, 1)^2.
Vec3d direction_in_cell(double column, double row, int columns, int rows) {
  const double y = 1 - 2 * row / rows;
  const double level = std::sqrt(std::max(0.0, 1 - y * y));
  const double angle = 2 * std::numbers::pi * column / columns;
  return {level * std::cos(angle), y, level * std::sin(angle)};
}

TEST(SkyMap, the_middle_of_the_image_is_plus_x_and_the_top_is_up) {
  LatLongImage image = constant_image(8, 4, Vec3f(0));
  const auto row_of = [&](int row, int column, float value) {
    image.texels[row * 8 + column] = Vec3f(value);
  };
  for (int column = 0; column < 8; ++column) row_of(0, column, 1);
  for (int column = 0; column < 8; ++column) row_of(3, column, 2);
  row_of(1, 3, 3), row_of(1, 4, 3), row_of(2, 3, 3), row_of(2, 4, 3);
  row_of(1, 5, 4), row_of(1, 6, 4), row_of(2, 5, 4), row_of(2, 6, 4);
  const SkyMap map(image);
  EXPECT_NEAR(map.radiance({0, 1, 0}).x, 1, 1e-6);
  EXPECT_NEAR(map.radiance({0, -1, 0}).x, 2, 1e-6);
  EXPECT_NEAR(map.radiance({1, 0, 0}).x, 3, 1e-6);
  EXPECT_NEAR(map.radiance({0, 0, 1}).x, 4, 1e-6);
}

TEST(SkyMap, the_seam_is_as_smooth_as_the_rest) {
  LatLongImage image = constant_image(8, 4, Vec3f(1));
  for (int row = 0; row < 4; ++row) image.texels[row * 8] = Vec3f(3);
  const SkyMap map(image);
  const double nearly = 1e-6;
  EXPECT_NEAR(map.radiance(unit_or({-1, 0, nearly}, {})).x, 2, 1e-4);
  EXPECT_NEAR(map.radiance(unit_or({-1, 0, -nearly}, {})).x, 2, 1e-4);
}

TEST(SkyMap, texels_are_picked_as_often_as_their_pdf_and_solid_angle_say) {
  const SkyMap map(spotted_image());
  constexpr int columns = 32, rows = 16, samples = 400'000;
  std::vector<double> counts(columns * rows), expected(columns * rows), by_area(columns * rows);
  for (int row = 0; row < rows; ++row) {
    const double top = std::cos(std::numbers::pi * row / rows);
    const double bottom = std::cos(std::numbers::pi * (row + 1) / rows);
    const double measure = (top - bottom) * 2 * std::numbers::pi / columns;
    for (int column = 0; column < columns; ++column) {
      const double y = 0.5 * (top + bottom);
      const double angle = 2 * std::numbers::pi * (column + 0.5) / columns;
      const double level = std::sqrt(1 - y * y);
      const Vec3d towards(-level * std::cos(angle), y, -level * std::sin(angle));
      expected[row * columns + column] = samples * measure * map.pdf(towards);
      by_area[row * columns + column] = samples * measure / (4 * std::numbers::pi);
    }
  }
  std::mt19937_64 random(1);
  const auto next = [&] { return std::uniform_real_distribution<double>()(random); };
  for (int i = 0; i < samples; ++i) {
    const double u = next();
    const SkyMap::Sample sample = map.sample({u, next()});
    const Vec3d& d = sample.direction;
    const double azimuth = 0.5 + std::atan2(d.z, d.x) / (2 * std::numbers::pi);
    const double descent = std::acos(d.y) / std::numbers::pi;
    ++counts[static_cast<int>(descent * rows) * columns +
             std::min(static_cast<int>(azimuth * columns), columns - 1)];
  }
  EXPECT_LT(std::abs(test::chi_square_deviation(counts, expected)), 5);
  EXPECT_GT(test::chi_square_deviation(counts, by_area), 1000) << "the control";
}

TEST(SkyMap, a_sample_has_the_pdf_of_its_direction) {
  const SkyMap map(spotted_image());
  int differing = 0;
  for (uint64_t i = 0; i < 20'000; ++i) {
    const auto [u, v] = test::even_point<2>(i);
    const SkyMap::Sample sample = map.sample({u, v});
    ASSERT_NEAR(glm::length(sample.direction), 1, 1e-12);
    ASSERT_GT(sample.pdf, 0);
    // On an edge of texels rounding may tell the neighbour.
    differing += std::abs(map.pdf(sample.direction) / sample.pdf - 1) > 1e-9;
  }
  EXPECT_LE(differing, 2);
}

TEST(SkyMap, wherever_there_is_light_the_pdf_is_not_zero) {
  const SkyMap map(spotted_image());
  for (uint64_t i = 0; i < 100'000; ++i) {
    const auto [u, v] = test::even_point<2>(i);
    const Vec3d direction = direction_in_cell(u, v, 1, 1);
    if (luminance(map.radiance(direction)) > 0) {
      ASSERT_GT(map.pdf(direction), 0);
    }
  }
}

TEST(SkyMap, the_mean_of_radiance_over_pdf_is_the_integral) {
  for (const LatLongImage& image : {spotted_image(), constant_image(16, 8, {1, 2, 3})}) {
    const SkyMap map(image);
    double sampled = 0, integral = 0;
    constexpr int count = 4'000'000;
    for (uint64_t i = 0; i < count; ++i) {
      const auto [u, v] = test::even_point<2>(i);
      const SkyMap::Sample sample = map.sample({u, v});
      sampled += luminance(map.radiance(sample.direction)) / sample.pdf;
      integral += luminance(map.radiance(direction_in_cell(u, v, 1, 1)));
    }
    EXPECT_NEAR(sampled / (integral * 4 * std::numbers::pi), 1, 1e-4);
  }
}

TEST(SkyMap, a_black_map_is_black_and_says_so) {
  const SkyMap map(constant_image(4, 2, Vec3f(0)));
  EXPECT_EQ(map.radiance({0, 1, 0}), Vec3d(0));
  EXPECT_EQ(map.sample({0.5, 0.5}).pdf, 0);
  EXPECT_EQ(map.pdf({0, 1, 0}), 0);
}

}  // namespace
}  // namespace tracer
