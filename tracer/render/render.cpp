// SPDX-License-Identifier: MIT
#include "tracer/render/render.h"

#include <atomic>
#include <cassert>

#include <fmt/format.h>

#include "tracer/base/parallel.h"

namespace tracer {
namespace {

struct PixelSample {
  Ray ray;
  Sampler sampler;
};

/// Pixels are box filters: the ray goes through a point uniform in the pixel.
PixelSample start_sample(const World& world, const RenderSettings& settings, Vec2i size_px,
                         Vec2i pixel, uint32_t sample) {
  const uint32_t pixel_index = static_cast<uint32_t>(pixel.y) * static_cast<uint32_t>(size_px.x) +
                               static_cast<uint32_t>(pixel.x);
  Sampler sampler(pixel_index, sample, static_cast<uint32_t>(settings.seed));
  const Vec2d image_point = Vec2d(pixel) + sampler.next_2d();
  return {camera_ray(world.camera, image_point), sampler};
}

int first_multiple_from(int value, int stride) {
  return (value + stride - 1) / stride * stride;
}

/// What a pass does, the same for all its tiles.
struct PassContext {
  const World& world;
  const Integrator& integrator;
  const RenderSettings& settings;
  const Pass& pass;
  Film& film;
  const StopFlag& stop;
};

PassStats render_tile(const PassContext& context, const Tile& tile) {
  const Pass& pass = context.pass;
  Film& film = context.film;
  RayCaster rays(*context.world.accel, context.stop);
  PassStats stats;
  const auto render_missing_pixels = [&] {
    for (int y = first_multiple_from(tile.y0, pass.stride); y < tile.y1; y += pass.stride) {
      for (int x = first_multiple_from(tile.x0, pass.stride); x < tile.x1; x += pass.stride) {
        if (film.sample_count(x, y) > pass.sample) continue;
        assert(film.sample_count(x, y) == pass.sample);
        if (context.stop.requested()) return false;
        Vec3d radiance = render_sample(context.world, context.integrator, context.settings,
                                       film.size_px(), {x, y}, pass.sample, rays);
        // A stopped ray caster may have answered with misses.
        if (context.stop.requested()) return false;
        if (!is_finite(radiance)) {
          radiance = Vec3d(0);
          ++stats.dropped;
        }
        film.add(x, y, radiance);
        ++stats.samples;
      }
    }
    return true;
  };
  stats.is_complete = render_missing_pixels();
  stats.rays = rays.ray_count();
  return stats;
}

}  // namespace

Pass next_pass(const Pass& pass) {
  if (pass.stride > 1) return {pass.sample, pass.stride / 2};
  return {pass.sample + 1, 1};
}

PassStats render_pass(const World& world, const Integrator& integrator,
                      const RenderSettings& settings, const Pass& pass, Film& film,
                      const StopFlag& stop, const TileCallback& on_tile) {
  const PassContext context{world, integrator, settings, pass, film, stop};
  const std::vector<Tile> tiles = make_tiles(film.size_px());
  std::atomic<uint64_t> rays{0}, samples{0}, dropped{0};
  std::atomic<bool> is_complete{true};
  parallel_in_order(tiles.size(), [&](size_t i) {
    const PassStats stats = render_tile(context, tiles[i]);
    rays += stats.rays;
    samples += stats.samples;
    dropped += stats.dropped;
    if (!stats.is_complete) is_complete = false;
    if (stats.samples > 0 && on_tile) on_tile(tiles[i]);
  });
  return {rays, samples, dropped, is_complete};
}

Vec3d render_sample(const World& world, const Integrator& integrator,
                    const RenderSettings& settings, Vec2i size_px, Vec2i pixel, uint32_t sample,
                    RayCaster& rays) {
  auto [ray, sampler] = start_sample(world, settings, size_px, pixel, sample);
  return integrator.radiance(world, rays, ray, sampler, settings);
}

std::string describe_sample(const World& world, const Integrator& integrator,
                            const RenderSettings& settings, Vec2i size_px, Vec2i pixel,
                            uint32_t sample) {
  const StopFlag never;
  RayCaster rays(*world.accel, never);
  auto [ray, sampler] = start_sample(world, settings, size_px, pixel, sample);
  std::string text;
  const Vec3d radiance = integrator.describe(world, rays, ray, sampler, settings, text);
  text += fmt::format("radiance {:.9g} {:.9g} {:.9g}\n", radiance.x, radiance.y, radiance.z);
  return text;
}

}  // namespace tracer
