// SPDX-License-Identifier: MIT
#include "tracer/render/film_error.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random_source.h"
#include "tests/support/worlds.h"
#include "tracer/render/pass_schedule.h"

namespace tracer {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int promised_seeds = 10;
constexpr uint32_t reference_samples = 512;
#else
constexpr int promised_seeds = 200;
constexpr uint32_t reference_samples = 8192;
#endif

TEST(FilmHalves, are_the_first_samples_and_the_rest) {
  Film film({1, 1});
  EXPECT_EQ(film.halves(0, 0).rest_count, 0u);
  for (uint32_t i = 0; i < 300; ++i) {
    film.add(0, 0, Vec3d(i));
    const uint32_t count = i + 1;
    const SampleHalves halves = film.halves(0, 0);
    if (count < 2) continue;
    ASSERT_EQ(halves.first_count + halves.rest_count, count);
    ASSERT_EQ(std::popcount(halves.first_count), 1);
    ASSERT_GE(5 * halves.rest_count, count);
    ASSERT_LE(5 * halves.rest_count, 3 * count);
    // Of 0, 1, 2, …
    ASSERT_NEAR(halves.first.x, 0.5 * (halves.first_count - 1), 1e-4);
    ASSERT_NEAR(halves.rest.x, 0.5 * (halves.first_count + count - 1), 1e-4);
  }
}

double squared_error(const Image& image, const std::vector<Vec3f>& truth) {
  double sum = 0;
  for (size_t i = 0; i < truth.size(); ++i) {
    const Vec3d r(truth[i]);
    const Vec3d difference = Vec3d(image.pixels[i]) - r;
    const Vec3d part = difference * difference / (r * r + relmse_epsilon);
    sum += (part.x + part.y + part.z) / 3;
  }
  return sum / static_cast<double>(truth.size());
}

TEST(FilmError, is_infinite_before_a_second_sample) {
  Film film({4, 4});
  EXPECT_TRUE(std::isinf(estimate_error(film).relmse));
}

TEST(FilmError, of_samples_that_are_all_the_same_is_nothing) {
  Film film({40, 30});
  for (int i = 0; i < 11; ++i) {
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) film.add(x, y, Vec3d(0.5, x, y));
    }
  }
  EXPECT_LT(estimate_error(film).upper_bound(), 1e-12);
}

// Uniform noise, and rare flashes that may fall into either half.
TEST(FilmError, of_independent_samples_is_what_it_is) {
  for (const double flash : {0.0, 0.2}) {
    RandomSource random(7, 0);
    double estimated = 0, real = 0;
    for (int trial = 0; trial < 20; ++trial) {
      const Vec2i size(64, 48);
      Film film(size);
      std::vector<Vec3f> truth(static_cast<size_t>(size.x) * size.y);
      for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
          const double mean = 0.2 + x / 64.0;
          truth[static_cast<size_t>(y) * size.x + x] = Vec3f(static_cast<float>(mean));
          for (int i = 0; i < 96; ++i) {
            const bool is_flash = random.unit() < flash;
            const double noise = flash > 0 ? (is_flash ? 1 / flash : 0) : 2 * random.unit();
            film.add(x, y, Vec3d(mean * noise));
          }
        }
      }
      estimated += estimate_error(film).relmse;
      real += squared_error(film.image(), truth);
    }
    EXPECT_GT(estimated / real, 0.9) << flash;
    // Parts without a flash are dark, and weigh more.
    EXPECT_LT(estimated / real, flash > 0 ? 2.5 : 1.3) << flash;
  }
}

struct Promise {
  SamplerKind sampler;
  Allocation allocation;
};

class ErrorPromise : public testing::TestWithParam<Promise> {};

template <class IsEnough>
Film render_until(const World& world, const RenderSettings& settings, Vec2i size_px,
                  const IsEnough& is_enough) {
  Film film(size_px);
  const StopFlag never;
  PassSchedule schedule(settings);
  for (;;) {
    render_pass(world, integrators().front(), settings, schedule.pass(), film, never);
    schedule.advance(film);
    if (!schedule.is_estimate_due()) continue;
    if (is_enough(estimate_error(film))) return film;
  }
}

TEST_P(ErrorPromise, is_kept_by_19_of_20_pictures) {
  constexpr double asked = 0.01;
  const Vec2i size(48, 32);
  const World world = test::make_room(size);
  RenderSettings settings{.sampler = GetParam().sampler, .allocation = GetParam().allocation};
  settings.seed = 1 << 20;
  const std::vector<Vec3f> truth =
      test::render(world, integrators().front(), settings, size, reference_samples).image().pixels;
  int kept = 0;
  for (settings.seed = 0; settings.seed < promised_seeds; ++settings.seed) {
    const Film film = render_until(
        world, settings, size, [](const FilmError& error) { return error.upper_bound() <= asked; });
    kept += squared_error(film.image(), truth) <= asked ? 1 : 0;
  }
  RecordProperty("kept", kept);
  EXPECT_GE(kept, 0.95 * promised_seeds);
}

INSTANTIATE_TEST_SUITE_P(
    Samplers, ErrorPromise,
    testing::Values(Promise{SamplerKind::sobol, Allocation::even},
                    Promise{SamplerKind::independent, Allocation::even},
                    Promise{SamplerKind::sobol, Allocation::adaptive},
                    Promise{SamplerKind::independent, Allocation::adaptive}),
    [](const auto& test) {
      return std::string(test.param.sampler == SamplerKind::sobol ? "sobol" : "independent") +
             (test.param.allocation == Allocation::even ? "_even" : "_adaptive");
    });

}  // namespace
}  // namespace tracer
