// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/render/integrator.h"

namespace tracer {

/// Whether all surfaces are plain, as SceneProfile has it, the sky is constant and no sample is
/// cut.
bool can_find_diffuse_paths(const World& world, const RenderSettings& settings);

/// What Path finds where that is so: the same bits, as many paths at once as there are doubles in a
/// vector.
void diffuse_paths(const World& world, RayCaster& rays, const RenderSettings& settings,
                   const SampleBlock& block);

}  // namespace tracer
