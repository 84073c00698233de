// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/render/film.h"

namespace bench {

/// The mean over pixels of LDR-FLIP [Andersson 2020], 0 to 1: the difference that is seen when one
/// flips between two pictures, shown in sRGB, clipped at white, 67 pixels to a degree of sight. Of
/// equal sizes.
double mean_flip(const tracer::Image& test, const tracer::Image& reference);

}  // namespace bench
