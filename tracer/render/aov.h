// SPDX-License-Identifier: MIT
// The table of arbitrary output variables. To add one: one line in aov.cpp.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "tracer/render/film.h"
#include "tracer/render/image_layer.h"
#include "tracer/render/integrator.h"

namespace tracer {

/// The samples of a pixel whose mean an averaged variable is.
inline constexpr uint32_t averaged_aov_samples = 16;

/// What is known of each pixel beside its colour. It is found after the picture, along the same
/// camera rays, so that what is not asked for costs nothing.
struct Aov {
  std::string_view name;  // as on the command line, and of the layer
  std::string_view what;
  std::string_view channels;
  uint32_t samples;       // whose mean it is; 0: it is told by the film alone
  RadianceFunction find;  // in the place of radiance; nullptr where the film tells
  void (*fill)(const Film& picture, const Film& found, ImageLayer& layer);
};

std::span<const Aov> aovs();
/// nullptr when there is none of that name.
const Aov* find_aov(std::string_view name);

/// One layer each, of the picture in the film: with the same bits whatever the tree and the
/// threads. `most_samples` bounds the samples that are averaged.
std::vector<ImageLayer> render_aovs(std::span<const Aov* const> wanted, const World& world,
                                    const RenderSettings& settings, const Film& picture,
                                    uint32_t most_samples);

}  // namespace tracer
