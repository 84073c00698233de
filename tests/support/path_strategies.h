// SPDX-License-Identifier: MIT
// Path tracing with each way of finding lights, for tests that compare them.
#pragma once

#include "tracer/render/path.h"

namespace tracer::test {

template <LightStrategy strategy>
void radiance_by(const World& world, RayCaster& rays, const RenderSettings& settings,
                 const SampleBlock& block) {
  NoRecorder recorder;
  BasicPath<strategy>::radiance(world, rays, settings, block, recorder);
}

/// What users choose: both ways together.
inline const Integrator& path() {
  return *find_integrator("path");
}
inline const Integrator by_lights{"", "", "", radiance_by<LightStrategy::light_sampling>, nullptr};
inline const Integrator by_scattering{"", "", "", radiance_by<LightStrategy::scattering>, nullptr};

}  // namespace tracer::test
