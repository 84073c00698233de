// SPDX-License-Identifier: MIT
#include "tracer/render/sample_rates.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random_source.h"
#include "tests/support/worlds.h"
#include "tracer/base/parallel.h"
#include "tracer/render/film_error.h"
#include "tracer/render/pass_schedule.h"

namespace tracer {
namespace {

constexpr Vec2i size_px(64, 64);

template <class Value>
void add_samples(Film& film, int count, const Value& value) {
  for (int i = 0; i < count; ++i) {
    for (int y = 0; y < film.size_px().y; ++y) {
      for (int x = 0; x < film.size_px().x; ++x) film.add(x, y, Vec3d(value(x, y)));
    }
  }
}

TEST(SampleRates, are_even_at_first_and_where_nothing_is_noisy) {
  Film film(size_px);
  EXPECT_TRUE(film.rates().are_even());
  add_samples(film, 16, [](int x, int) { return x; });
  const SampleRates rates(film);
  for (int x = 0; x < 64; ++x) EXPECT_EQ(rates.rate(x, 5), 1);
}

TEST(SampleRates, follow_the_deviation_of_one_sample) {
  Film film(size_px);
  RandomSource random(3, 0);
  add_samples(film, 64,
              [&](int x, int) { return 1 + (x < 32 ? 0.4 : 0.1) * (random.unit() - 0.5); });
  const SampleRates rates(film);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 16; ++x) {
      ASSERT_GT(rates.rate(x, y), 0.6f);
      ASSERT_NEAR(rates.rate(63 - x, y), 0.25f, 0.1f);
    }
  }
}

// Two films that differ in one pixel alone, with squares elsewhere that set the full rate.
TEST(SampleRates, of_a_pixel_do_not_depend_on_its_own_samples) {
  const auto film_with = [](double strange) {
    Film film(size_px);
    RandomSource random(5, 0);
    add_samples(film, 16, [&](int x, int y) {
      const double noise = (y >= 40 ? 1.0 : 0.1) * (random.unit() - 0.5);
      return x == 11 && y == 12 ? strange * random.unit() : 1 + noise;
    });
    return film;
  };
  const SampleRates usual(film_with(0.1)), bright(film_with(1)), flashing(film_with(100));
  EXPECT_EQ(usual.rate(11, 12), bright.rate(11, 12));
  // Its neighbours' do.
  EXPECT_LT(usual.rate(12, 12), bright.rate(12, 12));
  EXPECT_LT(usual.rate(12, 12), flashing.rate(12, 12));
}

/// Mean of a film that settles where it thinks that it may: `allocate` picks the rates after 16
/// samples, each of which is a flash of 32 or nothing.
template <class Allocate>
double mean_with(const Allocate& allocate) {
  constexpr double probability = 1.0 / 32;
  double sum = 0;
  constexpr int trials = 60;
  for (int trial = 0; trial < trials; ++trial) {
    RandomSource random(11, static_cast<uint64_t>(trial));
    const auto sample = [&](int, int) { return random.unit() < probability ? 1 / probability : 0; };
    Film film(size_px);
    add_samples(film, 16, sample);
    allocate(film);
    for (uint32_t count = 17; count <= 64; ++count) {
      for (int y = 0; y < size_px.y; ++y) {
        for (int x = 0; x < size_px.x; ++x) {
          if (film.is_due(x, y, count)) film.add(x, y, Vec3d(sample(x, y)));
        }
      }
    }
    for (const Vec3f& pixel : film.image().pixels) sum += pixel.x;
  }
  return sum / (trials * size_px.x * size_px.y);
}

TEST(SampleRates, do_not_darken_the_picture) {
  // 60 x 4,096 pixels of 16 to 64 samples, of deviation 5.6: 0.003 is four standard errors.
  const double adaptive = mean_with([](Film& film) { film.set_rates(SampleRates(film)); });
  EXPECT_NEAR(adaptive, 1, 0.012);
  // The control: pixels that stop where their own samples are all alike.
  double sum = 0;
  RandomSource random(13, 0);
  constexpr int pixels = 100000;
  for (int pixel = 0; pixel < pixels; ++pixel) {
    Film film({1, 1});
    const auto add = [&](int count) {
      for (int i = 0; i < count; ++i) film.add(0, 0, Vec3d(random.unit() < 1.0 / 32 ? 32 : 0));
    };
    add(16);
    if (pixel_error(film, 0, 0) > 0) add(48);
    sum += film.mean(0, 0).x;
  }
  EXPECT_LT(sum / pixels, 0.9);
}

TEST(AdaptiveSampling, has_the_same_bits_at_any_number_of_threads_and_size_of_tiles) {
  const Vec2i size(75, 53);
  const World world = test::make_room(size);
  const RenderSettings settings{.allocation = Allocation::adaptive};
  const auto picture = [&](int threads, int tile_px) {
    Film film(size);
    const StopFlag never;
    with_thread_count(threads, [&] {
      for (PassSchedule schedule(settings); schedule.pass().sample < 48; schedule.advance(film)) {
        render_tiles(world, integrators().front(), settings, schedule.pass(),
                     make_tiles(size, tile_px), film, never);
      }
    });
    return film;
  };
  const Film expected = picture(1, tile_size_px);
  EXPECT_LT(expected.sample_count(0, 0), 48u);
  EXPECT_FALSE(expected.rates().are_even());
  for (const auto& [threads, tile_px] : {std::pair(2, 64), {3, 8}, {2, 13}}) {
    const Film film = picture(threads, tile_px);
    EXPECT_EQ(film.image().pixels, expected.image().pixels) << threads << ' ' << tile_px;
  }
}

}  // namespace
}  // namespace tracer
