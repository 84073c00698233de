// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/render/integrator.h"

namespace tracer {

/// What Path finds where all surfaces are plain, as SceneProfile has it: the same bits, as many
/// paths at once as there are doubles in a vector.
void diffuse_paths(const World& world, RayCaster& rays, const RenderSettings& settings,
                   const SampleBlock& block);

}  // namespace tracer
