// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "tracer/render/sampler.h"
#include "tracer/scene/camera.h"

namespace tracer {

/// Rays through a point of each pixel, uniform in it by the next pair of the pixel's sampler:
/// pixels are box filters. All spans are of one size, at most SampleBlock::max_size, and the
/// samplers have been asked for as many numbers.
void camera_rays(const CameraFrame& camera, std::span<const Vec2i> pixels,
                 std::span<Sampler> samplers, std::span<Ray> rays);

}  // namespace tracer
