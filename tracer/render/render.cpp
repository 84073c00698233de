// SPDX-License-Identifier: MIT
#include "tracer/render/render.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "tracer/base/parallel.h"
#include "tracer/render/camera_rays.h"
#include "tracer/render/pass_through.h"

namespace tracer {
namespace {

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

/// In Morton order: 4 pixels in a row are a square, and 16, and 64.
Vec2i place_in_block(int i) {
  const auto every_other_bit = [](int bits) {
    return (bits & 1) | (bits >> 1 & 2) | (bits >> 2 & 4) | (bits >> 3 & 8);
  };
  return {every_other_bit(i), every_other_bit(i >> 1)};
}

constexpr int block_side = 8;

/// Pixels that are due for a sample, and what is found for them.
struct PixelBlock {
  static constexpr size_t capacity = block_side * block_side;
  static_assert(capacity <= SampleBlock::max_size);

  std::array<Vec2i, capacity> pixels;
  std::array<Ray, capacity> rays;
  std::array<Hit, capacity> hits;
  std::array<Sampler, capacity> samplers;
  std::array<Vec3d, capacity> radiance;
  size_t count = 0;
  bool can_meet = true;
};

/// Renders a tile's part of a pass, block by block.
class TileRenderer {
 public:
  TileRenderer(const PassContext& context, const Tile& tile)
      : context_(context),
        tile_(tile),
        rays_(*context.world.accel, context.stop),
        samplers_(context.settings.sampler, static_cast<uint32_t>(context.settings.seed)) {}

  PassStats run() {
    stats_.is_complete = render_blocks();
    stats_.rays = rays_.ray_count();
    return stats_;
  }

 private:
  // False when stopped, as are those below.
  bool render_blocks() {
    const int stride = context_.pass.stride;
    for (int y = first_multiple_from(tile_.y0, stride); y < tile_.y1; y += block_side * stride) {
      for (int x = first_multiple_from(tile_.x0, stride); x < tile_.x1; x += block_side * stride) {
        if (!gather({x, y})) return false;
      }
    }
    return render_block();
  }

  // The pixels of a square that are due, into blocks that are rendered when they are full.
  bool gather(Vec2i first) {
    const int stride = context_.pass.stride;
    const Vec2d end(first + block_side * stride);
    const bool can_meet =
        !context_.settings.skips || tracer::can_meet(context_.world.camera, Vec2d(first), end,
                                                     context_.world.scene->mesh->bounds);
    if (can_meet != block_.can_meet && !render_block()) return false;
    block_.can_meet = can_meet;
    for (int i = 0; i < block_side * block_side; ++i) {
      const Vec2i pixel = first + stride * place_in_block(i);
      if (pixel.x >= tile_.x1 || pixel.y >= tile_.y1) continue;
      if (!context_.film.is_due(pixel.x, pixel.y, context_.pass.sample + 1)) continue;
      const uint32_t sample = context_.film.sample_count(pixel.x, pixel.y);
      block_.pixels[block_.count] = pixel;
      block_.samplers[block_.count] = samplers_.sampler(pixel, sample);
      if (++block_.count == PixelBlock::capacity && !render_block()) return false;
    }
    return true;
  }

  bool render_block() {
    if (block_.count == 0) return true;
    camera_rays(context_.world.camera, {block_.pixels.data(), block_.count},
                {block_.samplers.data(), block_.count}, {block_.rays.data(), block_.count});
    // Where a ray may take milliseconds, a stop loses but one sample.
    const size_t together = context_.world.accel->wide ? PixelBlock::capacity : 1;
    for (size_t first = 0; first < block_.count; first += together) {
      if (!render_samples(first, std::min(together, block_.count - first))) return false;
    }
    block_.count = 0;
    return true;
  }

  bool render_samples(size_t first, size_t count) {
    if (context_.stop.requested()) return false;
    if (block_.can_meet) {
      rays_.closest_hits({&block_.rays[first], count}, {&block_.hits[first], count});
    } else {
      std::fill_n(&block_.hits[first], count, Hit{});
    }
    const Scene& scene = *context_.world.scene;
    for (size_t i = first; scene.surfaces.has_alpha && i < first + count; ++i) {
      block_.hits[i] =
          pass_through(scene, rays_, block_.samplers[i], block_.rays[i], block_.hits[i]);
    }
    context_.integrator.radiance(context_.world, rays_, context_.settings,
                                 {.camera_rays = {&block_.rays[first], count},
                                  .camera_hits = {&block_.hits[first], count},
                                  .samplers = {&block_.samplers[first], count},
                                  .radiance = {&block_.radiance[first], count}});
    // A stopped ray caster may have answered with misses.
    if (context_.stop.requested()) return false;
    for (size_t i = first; i < first + count; ++i) {
      add_sample(block_.pixels[i], block_.radiance[i]);
    }
    return true;
  }

  void add_sample(Vec2i pixel, const Vec3d& radiance) {
    const bool is_usable = is_finite(radiance);
    ++stats_.samples;
    if (!is_usable) {
      const uint32_t sample = context_.film.sample_count(pixel.x, pixel.y);
      stats_.add({.dropped = 1, .first_dropped = SampleId{pixel, sample}});
    }
    context_.film.add(pixel.x, pixel.y, is_usable ? radiance : Vec3d(0));
  }

  const PassContext& context_;
  const Tile& tile_;
  RayCaster rays_;
  SamplerSource samplers_;
  PassStats stats_;
  PixelBlock block_;
};

/// Starts a sample and has it answered as a block of one.
template <class Answer>
Vec3d answer_sample(const World& world, const RenderSettings& settings, Vec2i pixel,
                    uint32_t sample, RayCaster& rays, const Answer& answer) {
  Sampler sampler(settings.sampler, pixel, sample, static_cast<uint32_t>(settings.seed));
  Ray ray;
  camera_rays(world.camera, {&pixel, 1}, {&sampler, 1}, {&ray, 1});
  Hit hit = rays.closest_hit(ray);
  if (world.scene->surfaces.has_alpha) {
    hit = pass_through(*world.scene, rays, sampler, ray, hit);
  }
  Vec3d radiance(0);
  answer(SampleBlock{.camera_rays = {&ray, 1},
                     .camera_hits = {&hit, 1},
                     .samplers = {&sampler, 1},
                     .radiance = {&radiance, 1}});
  return radiance;
}

}  // namespace

void PassStats::add(const PassStats& other) {
  rays += other.rays;
  samples += other.samples;
  dropped += other.dropped;
  const auto place = [](const SampleId& id) {
    return std::tuple(id.sample, id.pixel.y, id.pixel.x);
  };
  if (!other.first_dropped) return;
  if (!first_dropped || place(*other.first_dropped) < place(*first_dropped)) {
    first_dropped = other.first_dropped;
  }
}

Pass next_pass(const Pass& pass) {
  if (pass.stride > 1) return {pass.sample, pass.stride / 2};
  return {pass.sample + 1, 1};
}

PassStats render_pass(const World& world, const Integrator& integrator,
                      const RenderSettings& settings, const Pass& pass, Film& film,
                      const StopFlag& stop, const TileCallback& on_tile) {
  return render_tiles(world, integrator, settings, pass, make_tiles(film.size_px()), film, stop,
                      on_tile);
}

PassStats render_tiles(const World& world, const Integrator& integrator,
                       const RenderSettings& settings, const Pass& pass,
                       std::span<const Tile> tiles, Film& film, const StopFlag& stop,
                       const TileCallback& on_tile) {
  const PassContext context{world, integrator, settings, pass, film, stop};
  std::vector<PassStats> parts(tiles.size());
  parallel_in_order(tiles.size(), [&](size_t i) {
    parts[i] = TileRenderer(context, tiles[i]).run();
    if (parts[i].samples > 0 && on_tile) on_tile(tiles[i]);
  });
  PassStats all;
  for (const PassStats& part : parts) all.add(part);
  all.is_complete = std::ranges::all_of(parts, &PassStats::is_complete);
  return all;
}

Vec3d render_sample(const World& world, const Integrator& integrator,
                    const RenderSettings& settings, Vec2i pixel, uint32_t sample, RayCaster& rays) {
  const auto find_radiance = [&](const SampleBlock& block) {
    integrator.radiance(world, rays, settings, block);
  };
  return answer_sample(world, settings, pixel, sample, rays, find_radiance);
}

std::string describe_sample(const World& world, const Integrator& integrator,
                            const RenderSettings& settings, Vec2i pixel, uint32_t sample) {
  const StopFlag never;
  RayCaster rays(*world.accel, never);
  std::string text;
  const auto describe = [&](const SampleBlock& block) {
    integrator.describe(world, rays, settings, block, text);
  };
  const Vec3d radiance = answer_sample(world, settings, pixel, sample, rays, describe);
  text += fmt::format("radiance {:.9g} {:.9g} {:.9g}\n", radiance.x, radiance.y, radiance.z);
  return text;
}

}  // namespace tracer
