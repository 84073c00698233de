// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "tracer/base/progress.h"
#include "tracer/render/film.h"
#include "tracer/render/integrator.h"

namespace tracer {

/// One sample of every pixel on a grid. The first sample is traced coarse to fine, stride 8, 4, 2,
/// 1, and each pixel but once: a pass passes over pixels that have the sample already.
struct Pass {
  uint32_t sample = 0;
  int stride = 1;
};

/// The pass after this one: 8, 4, 2, 1 of sample 0, then 1 of each sample.
inline constexpr Pass first_pass{0, 8};
Pass next_pass(const Pass& pass);

struct SampleId {
  Vec2i pixel{};
  uint32_t sample = 0;

  friend bool operator==(const SampleId&, const SampleId&) = default;
};

struct PassStats {
  uint64_t rays = 0;
  uint64_t samples = 0;                   // of pixels, added to the film
  uint64_t dropped = 0;                   // samples that were not finite, counted as black
  std::optional<SampleId> first_dropped;  // of them all by sample, row and column
  bool is_complete =
      false;  // false when stopped; the film stays valid, and the pass can be resumed

  /// Adds what was counted.
  void add(const PassStats& other);
};

/// Called from a worker thread when a tile's part of the pass is done, or as much of it as a stop
/// lets be, and the film holds it.
using TileCallback = std::function<void(const Tile&)>;

/// Traces `pass` into the film, in parallel, and returns when it is done or stopped: at most some
/// milliseconds after `stop`. The film's bits depend on the world and settings only.
PassStats render_pass(const World& world, const Integrator& integrator,
                      const RenderSettings& settings, const Pass& pass, Film& film,
                      const StopFlag& stop, const TileCallback& on_tile = {});

/// The radiance of one sample of one pixel, as render_pass computes it.
Vec3d render_sample(const World& world, const Integrator& integrator,
                    const RenderSettings& settings, Vec2i pixel, uint32_t sample, RayCaster& rays);

/// The path of one sample in words, a line a vertex: where, what was hit, throughput, radiance.
std::string describe_sample(const World& world, const Integrator& integrator,
                            const RenderSettings& settings, Vec2i pixel, uint32_t sample);

}  // namespace tracer
