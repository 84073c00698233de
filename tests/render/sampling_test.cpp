// SPDX-License-Identifier: MIT
#include "tracer/render/sampling.h"

#include <vector>

#include <gtest/gtest.h>

#include "tracer/base/directions.h"
#include "tracer/render/render_settings.h"
#include "tracer/render/sampler.h"

namespace tracer {
namespace {

/// Upper bound of a chi-square of `degrees` degrees that chance exceeds once in some 30,000 times.
double chi_square_limit(int degrees) {
  return degrees + 4 * std::sqrt(2.0 * degrees) + 12;
}

/// Chi-square of counts that should all be equal.
double chi_square_of_equal(const std::vector<int>& counts) {
  double total = 0;
  for (const int count : counts) total += count;
  const double expected = total / static_cast<double>(counts.size());
  double sum = 0;
  for (const int count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
}

constexpr SamplerKind kinds[] = {SamplerKind::sobol, SamplerKind::independent};

TEST(Sampler, is_uniform_over_pixels_samples_dimensions_and_seeds) {
  constexpr int cells = 32;
  for (const SamplerKind kind : kinds) {
    std::vector<int> pixels(cells * cells), samples(cells * cells), dimensions(cells * cells),
        seeds(cells * cells);
    const auto count = [&](std::vector<int>& counts, const Vec2d& u) {
      ASSERT_LT(u.x, 1);
      ASSERT_LT(u.y, 1);
      ++counts[static_cast<size_t>(u.x * cells) * cells + static_cast<size_t>(u.y * cells)];
    };
    Sampler walk(kind, {3, 2}, 5, 0);
    for (uint32_t i = 0; i < 400'000; ++i) {
      count(pixels, Sampler(kind, Vec2i(i % 1000, i / 1000), 0, 0).next_2d());
      count(samples, Sampler(kind, {17, 4}, i, 0).next_2d());
      count(dimensions, walk.next_2d());
      count(seeds, Sampler(kind, {17, 4}, 3, i).next_2d());
    }
    for (const auto& counts : {pixels, samples, dimensions, seeds}) {
      EXPECT_LT(chi_square_of_equal(counts), chi_square_limit(cells * cells - 1));
    }
  }
}

TEST(Sampler, each_dimension_is_uniform_over_samples_of_many_pixels) {
  constexpr int cells = 256;
  for (const SamplerKind kind : kinds) {
    std::vector<std::vector<int>> counts(700, std::vector<int>(cells));
    for (int i = 0; i < 16 * 500; ++i) {
      // One pixel of each block: its neighbours' numbers keep apart.
      Sampler sampler(kind, Vec2i(16 * (i / 16 % 100), 16 * (i / 1600)), i % 16, 2);
      for (auto& of_dimension : counts) ++of_dimension[static_cast<size_t>(sampler.next() * cells)];
    }
    for (const auto& of_dimension : counts) {
      EXPECT_LT(chi_square_of_equal(of_dimension), chi_square_limit(cells - 1));
    }
  }
}

TEST(Sampler, seeds_and_dimensions_are_independent) {
  constexpr int count = 200'000;
  for (const SamplerKind kind : kinds) {
    double by_seed = 0, by_dimension = 0;
    for (int i = 0; i < count; ++i) {
      const Vec2i pixel(i % 500, i / 500);
      const auto sample = static_cast<uint32_t>(i % 7);
      Sampler sampler(kind, pixel, sample, 0);
      const double here = sampler.next() - 0.5;
      by_dimension += here * (sampler.next() - 0.5);
      by_seed += here * (Sampler(kind, pixel, sample, 1).next() - 0.5);
    }
    const double limit = 4 / std::sqrt(static_cast<double>(count)) / 12;
    EXPECT_LT(std::abs(by_seed / count), limit);
    EXPECT_LT(std::abs(by_dimension / count), 2 * limit);  // squares of pixels are alike
  }
}

TEST(Sampler, independent_neighbouring_pixels_and_samples_are) {
  constexpr int count = 200'000;
  double by_pixel = 0, by_sample = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const double here = Sampler(i, i / 7, 0).next() - 0.5;
    by_pixel += here * (Sampler(i + 1, i / 7, 0).next() - 0.5);
    by_sample += here * (Sampler(i, i / 7 + 1, 0).next() - 0.5);
  }
  const double limit = 4 / std::sqrt(static_cast<double>(count)) / 12;
  EXPECT_LT(std::abs(by_pixel / count), limit);
  EXPECT_LT(std::abs(by_sample / count), limit);
}

TEST(Sampler, equal_arguments_give_equal_numbers) {
  for (const SamplerKind kind : kinds) {
    Sampler a(kind, {1, 4}, 2, 3);
    Sampler b(kind, {1, 4}, 2, 3);
    for (int i = 0; i < 10; ++i) EXPECT_EQ(a.next(), b.next());
  }
}

TEST(Sampler, table_lists_every_kind_once_and_the_default_first) {
  ASSERT_EQ(samplers().size(), std::size(kinds));
  for (size_t i = 0; i < std::size(kinds); ++i) EXPECT_EQ(samplers()[i].value, kinds[i]);
  EXPECT_EQ(RenderSettings{}.sampler, samplers().front().value);
}

TEST(CosineHemisphere, is_distributed_as_its_pdf_says) {
  // sin^2 of the polar angle and the azimuth are uniform when the pdf is cosine / pi.
  for (const Vec3d& normal : {Vec3d(0, 0, 1), Vec3d(0, 0, -1), glm::normalize(Vec3d(1, -2, 3))}) {
    const Tangents tangents = tangents_of(normal);
    constexpr int cells = 20;
    std::vector<int> counts(cells * cells);
    Sampler sampler(0, 0, 4);
    for (int i = 0; i < 400'000; ++i) {
      const Vec3d direction = sample_cosine_hemisphere(normal, sampler.next_2d());
      ASSERT_NEAR(glm::length(direction), 1, 1e-14);
      const double cosine = glm::dot(direction, normal);
      ASSERT_GT(cosine, 0);
      const double azimuth =
          std::atan2(glm::dot(direction, tangents.y), glm::dot(direction, tangents.x));
      const auto ring = std::min(cells - 1, static_cast<int>((1 - cosine * cosine) * cells));
      const auto sector =
          std::min(cells - 1, static_cast<int>((azimuth / (2 * std::numbers::pi) + 0.5) * cells));
      ++counts[static_cast<size_t>(ring * cells + sector)];
    }
    EXPECT_LT(chi_square_of_equal(counts), chi_square_limit(cells * cells - 1));
  }
}

TEST(CosineHemisphere, pdf_integrates_to_1_and_is_0_below) {
  constexpr int steps = 100'000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    sum += 2 * std::numbers::pi * pdf_cosine_hemisphere((i + 0.5) / steps) / steps;
  }
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_EQ(pdf_cosine_hemisphere(-0.5), 0);
}

TEST(SampleTriangle, is_uniform_by_area) {
  // Cells of equal area: rows of equal area from one corner, halved along them.
  constexpr int cells = 16;
  std::vector<int> counts(cells * cells);
  Sampler sampler(0, 0, 5);
  for (int i = 0; i < 400'000; ++i) {
    const Vec2d weights = sample_triangle(sampler.next_2d());
    ASSERT_GE(weights.x, 0);
    ASSERT_GE(weights.y, 0);
    ASSERT_LE(weights.x + weights.y, 1);
    const double sum = weights.x + weights.y;
    const int row = std::min(cells - 1, static_cast<int>(sum * sum * cells));
    const int column = std::min(cells - 1, static_cast<int>(sum > 0 ? weights.y / sum * cells : 0));
    ++counts[static_cast<size_t>(row * cells + column)];
  }
  EXPECT_LT(chi_square_of_equal(counts), chi_square_limit(cells * cells - 1));
}

TEST(Tangents, make_right_handed_orthonormal_frames) {
  Sampler sampler(0, 0, 6);
  for (int i = 0; i < 10'000; ++i) {
    const Vec3d z = i == 0   ? Vec3d(0, 0, -1)
                    : i == 1 ? Vec3d(0, 0, 1)
                             : unit_or(Vec3d(sampler.next(), sampler.next(), sampler.next()) - 0.5,
                                       Vec3d(1, 0, 0));
    const Tangents tangents = tangents_of(z);
    ASSERT_LT(max_abs(glm::cross(tangents.x, tangents.y) - z), 1e-14);
    ASSERT_NEAR(glm::length(tangents.x), 1, 1e-14);
    ASSERT_NEAR(glm::length(tangents.y), 1, 1e-14);
  }
}

TEST(PowerHeuristic, weights_of_two_ways_add_up_to_1) {
  for (const double ratio : {1e-200, 1e-3, 1.0, 7.0, 1e200}) {
    EXPECT_NEAR(power_heuristic(1, ratio) + power_heuristic(ratio, 1), 1, 1e-15);
  }
  EXPECT_EQ(power_heuristic(2, 0), 1);
}

}  // namespace
}  // namespace tracer
