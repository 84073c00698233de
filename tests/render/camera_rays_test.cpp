// SPDX-License-Identifier: MIT
#include "tracer/render/camera_rays.h"

#include <gtest/gtest.h>

#include "tests/support/instruction_sets.h"
#include "tests/support/random_source.h"
#include "tracer/render/integrator.h"

namespace tracer {
namespace {

TEST(CameraRays, are_those_of_single_pixels_with_every_instruction_set) {
  const CameraFrame camera = make_camera_frame(
      {.eye = {1, 2, 3}, .target = {0.1, -0.2, 0.3}, .fov_degrees = 50}, {1280, 720}, Vec3d(0));
  for_each_instruction_set([&](const std::string& name) {
    for (const SamplerKind kind : {SamplerKind::sobol, SamplerKind::independent}) {
      RandomSource random(1, 0);
      for (int block = 0; block < 300; ++block) {
        // Runs of one square and sample, as adaptive samples make them, and pixels from anywhere.
        const auto size = static_cast<size_t>(random.integer(1, SampleBlock::max_size));
        std::vector<Vec2i> pixels(size);
        std::vector<Sampler> samplers(size), expected_samplers(size);
        SamplerSource source(kind, 5);
        uint32_t sample = 0;
        for (size_t i = 0; i < size; ++i) {
          if (i == 0 || random.integer(0, 9) == 0) {
            pixels[i] = {random.integer(0, 1279), random.integer(0, 719)};
            sample = random.word() >> random.integer(0, 31);
          } else {
            pixels[i] = pixels[i - 1] + Vec2i(1, 0);
          }
          samplers[i] = source.sampler(pixels[i], sample);
          expected_samplers[i] = Sampler(kind, pixels[i], sample, 5);
        }
        std::vector<Ray> rays(size);
        camera_rays(camera, pixels, samplers, rays);
        for (size_t i = 0; i < size; ++i) {
          const Ray expected =
              camera_ray(camera, Vec2d(pixels[i]) + expected_samplers[i].next_2d());
          ASSERT_EQ(rays[i].origin, expected.origin);
          ASSERT_EQ(rays[i].direction, expected.direction) << name << ' ' << i << " of " << size;
          ASSERT_EQ(samplers[i].next(), expected_samplers[i].next());
          ASSERT_EQ(samplers[i].next_2d(), expected_samplers[i].next_2d());
        }
      }
    }
  });
}

}  // namespace
}  // namespace tracer
