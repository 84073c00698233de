// SPDX-License-Identifier: MIT
// Samples answered together: what a block may not change, and what it does with a stop.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/worlds.h"
#include "tracer/base/parallel.h"
#include "tracer/render/path.h"

namespace tracer {
namespace {

constexpr Vec2i size_px(64, 64);

template <LightStrategy strategy>
void radiance_by(const World& world, RayCaster& rays, const RenderSettings& settings,
                 const SampleBlock& block) {
  NoRecorder recorder;
  BasicPath<strategy>::radiance(world, rays, settings, block, recorder);
}

/// Those of the table, and the ways of finding lights that are not in it.
std::vector<Integrator> all_integrators() {
  std::vector<Integrator> all(integrators().begin(), integrators().end());
  all.push_back({"light sampling", "", "", radiance_by<LightStrategy::light_sampling>, nullptr});
  all.push_back({"scattering", "", "", radiance_by<LightStrategy::scattering>, nullptr});
  return all;
}

/// A block's samples at the start: every other pixel of a row and the next.
struct Samples {
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  std::vector<Sampler> samplers;
  std::vector<Vec3d> radiance;

  Samples(const World& world, int row) : radiance(size_px.x, Vec3d(-1)) {
    const StopFlag never;
    RayCaster caster(*world.accel, never);
    for (int i = 0; i < size_px.x; ++i) {
      samplers.emplace_back(static_cast<uint32_t>(row * size_px.x + i), 5, 3);
      const Vec2d image_point(i + 0.5, row + i % 2 + 0.5);
      rays.push_back(camera_ray(world.camera, image_point));
      hits.push_back(caster.closest_hit(rays.back()));
    }
  }

  SampleBlock block(size_t first, size_t count) {
    return {.camera_rays = {&rays[first], count},
            .camera_hits = {&hits[first], count},
            .samplers = {&samplers[first], count},
            .radiance = {&radiance[first], count}};
  }
};

struct Answers {
  std::vector<Vec3d> radiance;
  std::vector<double> next_random_numbers;
  uint64_t ray_count = 0;
  friend bool operator==(const Answers&, const Answers&) = default;
};

/// A row of samples in blocks of block_size, the last of what is left.
Answers answers_in_blocks(const World& world, const Integrator& integrator, int row,
                          size_t block_size) {
  const StopFlag never;
  RayCaster caster(*world.accel, never);
  Samples samples(world, row);
  for (size_t first = 0; first < samples.rays.size(); first += block_size) {
    const size_t count = std::min(block_size, samples.rays.size() - first);
    integrator.radiance(world, caster, {.bounces = 12}, samples.block(first, count));
  }
  Answers answers{samples.radiance, {}, caster.ray_count()};
  for (Sampler& sampler : samples.samplers) answers.next_random_numbers.push_back(sampler.next());
  return answers;
}

TEST(SampleBlock, answers_as_its_samples_do_alone_bit_for_bit_however_it_is_split) {
  const World world = test::make_room(size_px);
  for (const Integrator& integrator : all_integrators()) {
    for (const int row : {2, 20, 35, 50}) {
      const Answers alone = answers_in_blocks(world, integrator, row, 1);
      for (const size_t block_size : {2, 7, 9, 31, 63, 64}) {
        EXPECT_EQ(answers_in_blocks(world, integrator, row, block_size), alone)
            << integrator.name << ' ' << row << ' ' << block_size;
      }
    }
  }
}

TEST(SampleBlock, passes_trace_as_many_rays_in_blocks_as_one_by_one) {
  const StopFlag never;
  for (const Integrator& integrator : integrators()) {
    uint64_t ray_count[2] = {};
    for (const auto tracing : {test::Tracing::tree, test::Tracing::brute_force}) {
      Film film(size_px);
      ray_count[tracing == test::Tracing::tree] =
          render_pass(test::make_room(size_px, tracing), integrator, {}, {0, 1}, film, never).rays;
    }
    EXPECT_EQ(ray_count[0], ray_count[1]) << integrator.name;
    EXPECT_GE(ray_count[0], 64u * 64u);
  }
}

TEST(SampleBlock, one_sample_that_is_not_finite_leaves_its_neighbours_and_counts_as_black) {
  const Integrator one_broken{
      "", "", "",
      [](const World&, RayCaster&, const RenderSettings&, const SampleBlock& block) {
        std::ranges::fill(block.radiance, Vec3d(2));
        block.radiance.back() = Vec3d(1, NAN, 1);
      },
      nullptr};
  Film film(size_px);
  const StopFlag never;
  const PassStats stats =
      render_pass(test::make_room(size_px), one_broken, {}, {0, 1}, film, never);
  EXPECT_EQ(stats.samples, 64u * 64u);
  EXPECT_EQ(stats.dropped, 64u);
  int black = 0;
  for (int i = 0; i < 64 * 64; ++i) {
    ASSERT_EQ(film.sample_count(i % 64, i / 64), 1u);
    const Vec3f mean = film.mean(i % 64, i / 64);
    black += mean == Vec3f(0) ? 1 : 0;
    ASSERT_TRUE(mean == Vec3f(0) || mean == Vec3f(2));
  }
  EXPECT_EQ(black, 64);
}

StopFlag* flag_to_request = nullptr;
int calls_left = 0;

void answer_until_stopped(const World&, RayCaster&, const RenderSettings&,
                          const SampleBlock& block) {
  std::ranges::fill(block.radiance, Vec3d(1));
  if (--calls_left == 0) flag_to_request->request();
}

uint64_t samples_kept_when_stopped_in_the_third_call(test::Tracing tracing) {
  StopFlag stop;
  flag_to_request = &stop;
  calls_left = 3;
  Film film(size_px);
  const Integrator integrator{"", "", "", answer_until_stopped, nullptr};
  const PassStats stats = with_thread_count(1, [&] {
    return render_pass(test::make_room(size_px, tracing), integrator, {}, {0, 1}, film, stop);
  });
  EXPECT_FALSE(stats.is_complete);
  return stats.samples;
}

TEST(SampleBlock, a_stop_drops_the_block_that_it_falls_in_and_no_other) {
  EXPECT_EQ(samples_kept_when_stopped_in_the_third_call(test::Tracing::tree), 2u * 64);
}

TEST(SampleBlock, a_stop_drops_one_sample_where_rays_meet_every_triangle) {
  EXPECT_EQ(samples_kept_when_stopped_in_the_third_call(test::Tracing::brute_force), 2u);
}

}  // namespace
}  // namespace tracer
