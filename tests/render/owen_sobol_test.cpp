// SPDX-License-Identifier: MIT
// What docs/sampling.md promises of the points of a pixel, and of those of its neighbours.
#include "tracer/render/owen_sobol.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tracer/base/trigonometry.h"
#include "tracer/render/sampler.h"

namespace tracer {
namespace {

/// Whether 2^m points have one in each of the boxes of 2^-a by 2^-b, for all a + b = m.
bool is_net(const std::vector<DigitPair>& points) {
  const int m = std::countr_zero(points.size());
  for (int a = 0; a <= m; ++a) {
    std::vector<uint8_t> is_taken(points.size());
    for (const DigitPair& point : points) {
      const uint64_t column = static_cast<uint64_t>(point.x) << a >> 32;
      const uint64_t row = static_cast<uint64_t>(point.y) << (m - a) >> 32;
      uint8_t& box = is_taken[column << (m - a) | row];
      if (box != 0) return false;
      box = 1;
    }
  }
  return true;
}

/// Those of the first samples of the square of pixels from (x0, y0).
std::vector<DigitPair> points_of(uint32_t x0, uint32_t y0, uint32_t side, uint32_t sample_count,
                                 uint32_t dimension, uint32_t seed) {
  std::vector<DigitPair> points;
  for (uint32_t i = 0; i < side * side; ++i) {
    for (uint32_t sample = 0; sample < sample_count; ++sample) {
      points.push_back(OwenSobolSample(x0 + i % side, y0 + i / side, sample, seed).pair(dimension));
    }
  }
  return points;
}

TEST(OwenSobol, first_2_to_the_m_samples_of_a_pixel_are_nets_in_every_dimension) {
  for (const uint32_t dimension : {0u, 1u, 7u, 640u}) {
    for (uint32_t count = 1; count <= 4096; count *= 2) {
      EXPECT_TRUE(is_net(points_of(37, 91, 1, count, dimension, 5))) << dimension << ' ' << count;
    }
  }
}

TEST(OwenSobol, first_2_to_the_m_samples_of_aligned_squares_of_pixels_are_nets_together) {
  for (const uint32_t side : {2u, 4u, 8u, 16u}) {
    for (uint32_t count = 1; count <= 64; count *= 2) {
      EXPECT_TRUE(is_net(points_of(3 * side, 7 * side, side, count, 3, 1))) << side << ' ' << count;
    }
  }
}

TEST(OwenSobol, quarters_and_halves_of_an_octave_of_samples_are_nets) {
  for (uint32_t dimension = 0; dimension < 20; ++dimension) {
    for (const uint32_t size : {16u, 32u}) {
      for (uint32_t first = 64; first < 128; first += size) {
        std::vector<DigitPair> points;
        for (uint32_t i = 0; i < size; ++i) {
          points.push_back(OwenSobolSample(5, 6, first + i, 2).pair(dimension));
        }
        EXPECT_TRUE(is_net(points)) << first;
      }
    }
  }
}

// The control of the tests above.
TEST(OwenSobol, independent_points_are_no_nets) {
  std::vector<DigitPair> points;
  for (uint32_t i = 0; i < 16; ++i) {
    const Words4 words = hash_words({i, 1, 2, 3});
    points.push_back({words.x, words.y});
  }
  EXPECT_FALSE(is_net(points));
}

TEST(OwenSobol, single_numbers_are_the_first_of_the_pairs) {
  for (uint32_t i = 0; i < 1000; ++i) {
    const OwenSobolSample sample(i % 31, i / 31, i, 9);
    EXPECT_EQ(sample.number(i), sample.pair(i).x);
  }
}

TEST(OwenSobol, the_first_of_all_numbers_is_as_random_as_any) {
  const DigitPair first = OwenSobolSample(0, 0, 0, 0).pair(0);
  EXPECT_GE(std::min(first.x, first.y), 1u << 22);
}

TEST(OwenSobol, shuffles_visit_each_place_once) {
  for (uint32_t size = 1; size <= 1024; size *= 2) {
    for (uint32_t key = 1; key < 50; ++key) {
      std::vector<int> visits(size);
      for (uint32_t i = 0; i < size; ++i) ++visits[shuffle(i, size - 1, key * 0x9e3779b9u)];
      for (const int count : visits) ASSERT_EQ(count, 1);
    }
  }
}

/// Errors of each pixel of a picture, of an integrand whose mean is 1/4.
std::vector<double> errors(SamplerKind kind, int side, uint32_t sample_count, uint32_t seed) {
  std::vector<double> errors;
  for (int i = 0; i < side * side; ++i) {
    double sum = 0;
    for (uint32_t sample = 0; sample < sample_count; ++sample) {
      const Vec2d u = Sampler(kind, {i % side, i / side}, sample, seed).next_2d();
      sum += u.x * u.y;
    }
    errors.push_back(sum / sample_count - 0.25);
  }
  return errors;
}

double mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return sum / static_cast<double>(values.size());
}

/// The power of frequencies along x and y of at most `highest` cycles a picture, the mean left
/// out, relative to white noise of the same energy.
double low_frequency_power(const std::vector<double>& errors, int side, int highest) {
  double power = 0;
  int count = 0;
  for (int fy = 0; fy <= highest; ++fy) {
    for (int fx = 0; fx <= highest; ++fx) {
      if (fx + fy == 0) continue;
      double real = 0, imaginary = 0;
      for (int i = 0; i < side * side; ++i) {
        const CosSin wave = cos_sin_of_turns(std::fmod((fx * (i % side) + fy * (i / side)), side) /
                                             static_cast<double>(side));
        real += errors[static_cast<size_t>(i)] * wave.cos;
        imaginary += errors[static_cast<size_t>(i)] * wave.sin;
      }
      power += real * real + imaginary * imaginary;
      ++count;
    }
  }
  return power / count / (mean_square(errors) * side * side);
}

TEST(OwenSobol, errors_of_neighbouring_pixels_cancel_at_any_power_of_two_of_samples) {
  constexpr int side = 64;
  for (const uint32_t sample_count : {1u, 2u, 4u, 8u, 16u, 32u}) {
    double sobol = 0, independent = 0;
    for (uint32_t seed = 0; seed < 4; ++seed) {
      sobol +=
          low_frequency_power(errors(SamplerKind::sobol, side, sample_count, seed), side, 5) / 4;
      independent +=
          low_frequency_power(errors(SamplerKind::independent, side, sample_count, seed), side, 5) /
          4;
    }
    RecordProperty("low_frequencies_at_" + std::to_string(sample_count), std::to_string(sobol));
    std::printf("%u samples: low frequencies %.4f of white noise's, independent %.2f\n",
                sample_count, sobol, independent);
    EXPECT_LT(sobol, 0.2) << sample_count;
    EXPECT_GT(independent, 0.5) << sample_count;
  }
}

// Between powers of two the error may not rise above that of the power before.
TEST(OwenSobol, every_prefix_has_less_error_than_independent_samples) {
  for (uint32_t sample_count = 2; sample_count <= 96; ++sample_count) {
    const double variance = 7.0 / 144;  // of x y
    EXPECT_LT(mean_square(errors(SamplerKind::sobol, 16, sample_count, 3)),
              0.6 * variance / sample_count)
        << sample_count;
  }
}

TEST(OwenSobol, pixels_have_errors_without_bias_over_seeds) {
  double sum = 0, sum_of_squares = 0;
  constexpr uint32_t seed_count = 4000;
  for (uint32_t seed = 0; seed < seed_count; ++seed) {
    double value = 0;
    for (uint32_t sample = 0; sample < 3; ++sample) {
      Sampler sampler(SamplerKind::sobol, {21, 9}, sample, seed);
      const Vec2d u = sampler.next_2d();
      const Vec2d v = sampler.next_2d();
      value += u.x * u.y * v.x * v.y / 3;
    }
    sum += value;
    sum_of_squares += value * value;
  }
  const double mean = sum / seed_count;
  const double deviation = std::sqrt((sum_of_squares / seed_count - mean * mean) / seed_count);
  EXPECT_NEAR(mean, 1.0 / 16, 4 * deviation);
}

}  // namespace
}  // namespace tracer
