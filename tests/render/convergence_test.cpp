// SPDX-License-Identifier: MIT
// How errors fall with the number of samples.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/log_line.h"
#include "tests/support/worlds.h"
#include "tracer/render/integrator.h"

namespace tracer {
namespace {

class Convergence : public testing::Test {
 protected:
  static constexpr int size = 12;
  static constexpr int seed_count = 8;

  Image picture(SamplerKind sampler, int seed, uint32_t sample_count) const {
    RenderSettings settings;
    settings.sampler = sampler;
    settings.seed = seed;
    return test::render(world_, *find_integrator("path"), settings, {size, size}, sample_count)
        .image();
  }

  /// Of pictures of so many samples, the mean square of their difference from a reference whose
  /// halves share no noise with each other or with them.
  double mean_square_error(SamplerKind sampler, uint32_t sample_count) const {
    double sum = 0;
    for (int seed = 1; seed <= seed_count; ++seed) {
      const Image image = picture(sampler, seed, sample_count);
      for (size_t i = 0; i < image.pixels.size(); ++i) {
        const Vec3d from_first = Vec3d(image.pixels[i]) - Vec3d(first_.pixels[i]);
        const Vec3d from_second = Vec3d(image.pixels[i]) - Vec3d(second_.pixels[i]);
        sum += glm::dot(from_first, from_second);
      }
    }
    return sum / (3.0 * size * size * seed_count);
  }

  /// Of the logarithm of the root mean square error over that of the number of samples.
  double slope(SamplerKind sampler) const {
    std::vector<tests::LogPoint> points;
    for (uint32_t samples = 8; samples <= 512; samples *= 2) {
      points.push_back(
          {static_cast<double>(samples), std::sqrt(mean_square_error(sampler, samples))});
    }
    return tests::fit_log_line(points).slope;
  }

  World world_ = test::make_room({size, size});
  Image first_ = picture(SamplerKind::sobol, 1001, 8192);
  Image second_ = picture(SamplerKind::sobol, 1002, 8192);
};

TEST_F(Convergence, of_independent_samples_is_that_of_the_square_root) {
  const double measured = slope(SamplerKind::independent);
  EXPECT_GE(measured, -0.55);
  EXPECT_LE(measured, -0.45);
}

TEST_F(Convergence, of_sobol_samples_is_steeper) {
  EXPECT_LT(slope(SamplerKind::sobol), -0.55);
}

}  // namespace
}  // namespace tracer
