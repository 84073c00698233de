// SPDX-License-Identifier: MIT
// What the window can show of a film beside the picture itself.
#pragma once

#include <cstdint>
#include <vector>

#include "tracer/render/film.h"

namespace app {

enum class ShownMap {
  picture,
  samples,  // of a pixel, as a part of those that the noisiest pixels have
  error,    // of a pixel, estimated: pixel_error on a logarithmic scale
};

/// The ends of the error map's scale, relMSE.
inline constexpr double least_shown_error = 1e-5;
inline constexpr double greatest_shown_error = 1;

/// Colour of a place on a map's scale, linear RGB, lighter the larger `part` in [0, 1] is.
tracer::Vec3f map_color(double part);

/// Linear RGB of the tile's pixels, row by row. `sample_count` is that of the noisiest pixels.
/// Errors look at pixels beside the tile too: nobody may be adding samples to the film.
std::vector<tracer::Vec3f> shown_pixels(const tracer::Film& film, const tracer::Tile& tile,
                                        ShownMap map, uint32_t sample_count);

}  // namespace app
