// SPDX-License-Identifier: MIT
#include "tracer/render/render.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "tracer/base/parallel.h"

namespace tracer {
namespace {

struct PixelSample {
  Ray ray;
  Sampler sampler;
};

/// Pixels are box filters: the ray goes through a point uniform in the pixel.
PixelSample start_sample(const World& world, const RenderSettings& settings, Vec2i pixel,
                         uint32_t sample) {
  Sampler sampler(settings.sampler, pixel, sample, static_cast<uint32_t>(settings.seed));
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

/// In Morton order: 4 pixels in a row are a square, and 16, and 64.
Vec2i place_in_block(int i) {
  const auto every_other_bit = [](int bits) {
    return (bits & 1) | (bits >> 1 & 2) | (bits >> 2 & 4) | (bits >> 3 & 8);
  };
  return {every_other_bit(i), every_other_bit(i >> 1)};
}

constexpr int block_side = 8;

/// The pixels of a square that lack the pass's sample, and what is found for them.
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
      : context_(context), tile_(tile), rays_(*context.world.accel, context.stop) {}

  PassStats run() {
    stats_.is_complete = render_blocks();
    stats_.rays = rays_.ray_count();
    return stats_;
  }

 private:
  // False when stopped, as below.
  bool render_blocks() {
    const int stride = context_.pass.stride;
    for (int y = first_multiple_from(tile_.y0, stride); y < tile_.y1; y += block_side * stride) {
      for (int x = first_multiple_from(tile_.x0, stride); x < tile_.x1; x += block_side * stride) {
        gather({x, y});
        if (block_.count > 0 && !render_block()) return false;
      }
    }
    return true;
  }

  void gather(Vec2i first) {
    const Pass& pass = context_.pass;
    const Vec2d end(first + block_side * pass.stride);
    block_.can_meet = !context_.settings.skips || can_meet(context_.world.camera, Vec2d(first), end,
                                                           context_.world.scene->mesh->bounds);
    block_.count = 0;
    for (int i = 0; i < block_side * block_side; ++i) {
      const Vec2i pixel = first + pass.stride * place_in_block(i);
      if (pixel.x >= tile_.x1 || pixel.y >= tile_.y1) continue;
      if (context_.film.sample_count(pixel.x, pixel.y) > pass.sample) continue;
      assert(context_.film.sample_count(pixel.x, pixel.y) == pass.sample);
      const PixelSample start = start_sample(context_.world, context_.settings, pixel, pass.sample);
      block_.pixels[block_.count] = pixel;
      block_.rays[block_.count] = start.ray;
      block_.samplers[block_.count] = start.sampler;
      ++block_.count;
    }
  }

  bool render_block() {
    // Where a ray may take milliseconds, a stop loses but one sample.
    const size_t together = context_.world.accel->wide ? PixelBlock::capacity : 1;
    for (size_t first = 0; first < block_.count; first += together) {
      if (!render_samples(first, std::min(together, block_.count - first))) return false;
    }
    return true;
  }

  bool render_samples(size_t first, size_t count) {
    if (context_.stop.requested()) return false;
    if (block_.can_meet) {
      rays_.closest_hits({&block_.rays[first], count}, {&block_.hits[first], count});
    } else {
      std::fill_n(&block_.hits[first], count, Hit{});
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
      stats_.add({.dropped = 1, .first_dropped = SampleId{pixel, context_.pass.sample}});
    }
    context_.film.add(pixel.x, pixel.y, is_usable ? radiance : Vec3d(0));
  }

  const PassContext& context_;
  const Tile& tile_;
  RayCaster rays_;
  PassStats stats_;
  PixelBlock block_;
};

/// Starts a sample and has it answered as a block of one.
template <class Answer>
Vec3d answer_sample(const World& world, const RenderSettings& settings, Vec2i pixel,
                    uint32_t sample, RayCaster& rays, const Answer& answer) {
  auto [ray, sampler] = start_sample(world, settings, pixel, sample);
  const Hit hit = rays.closest_hit(ray);
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
  const PassContext context{world, integrator, settings, pass, film, stop};
  const std::vector<Tile> tiles = make_tiles(film.size_px());
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
