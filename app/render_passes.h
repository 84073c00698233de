// SPDX-License-Identifier: MIT
#pragma once

#include "app/render_command.h"
#include "tracer/render/film_error.h"
#include "tracer/render/render.h"

namespace app {

struct RenderedPasses {
  tracer::PassStats passes;                // of all passes together
  uint32_t whole_sample_count = 0;         // samples that the pixels of rate 1 have
  std::optional<tracer::FilmError> error;  // at the last look, where one is asked for
  double seconds = 0;
};

/// Renders into the film until the options' samples, seconds or error are reached, or `stop` is
/// requested; the first sample coarse to fine, so that the film is a picture whenever it ends.
RenderedPasses render_passes(const tracer::World& world, const RenderOptions& options,
                             tracer::Film& film, tracer::StopFlag& stop,
                             tracer::Progress& progress);

}  // namespace app
