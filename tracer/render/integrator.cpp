// SPDX-License-Identifier: MIT
#include "tracer/render/integrator.h"

#include <algorithm>
#include <cassert>

#include "tracer/render/path.h"
#include "tracer/render/preview.h"

namespace tracer {
namespace {

template <class Method>
void radiance(const World& world, RayCaster& rays, const RenderSettings& settings,
              const SampleBlock& block) {
  NoRecorder recorder;
  Method::radiance(world, rays, settings, block, recorder);
}

template <class Method>
void describe(const World& world, RayCaster& rays, const RenderSettings& settings,
              const SampleBlock& block, std::string& text) {
  assert(block.size() == 1);
  TextRecorder recorder(text, world.scene->mesh->origin);
  Method::radiance(world, rays, settings, block, recorder);
}

template <class Method>
constexpr Integrator integrator(std::string_view name, std::string_view label,
                                std::string_view what) {
  return {name, label, what, radiance<Method>, describe<Method>};
}

constexpr Integrator table[] = {
    integrator<Path>("path", "Path tracing",
                     "Diffuse surfaces lit by the sky and by emissive triangles."),
    integrator<EyeLight>("eyelight", "Eye light", "Lit by a lamp on the camera; no shadows."),
    integrator<Normals>("normals", "Normals", "Shading normals as colours."),
    integrator<AmbientOcclusion>("ao", "Ambient occlusion",
                                 "How much of the hemisphere is open at each point."),
};

}  // namespace

std::span<const Integrator> integrators() {
  return table;
}

const Integrator* find_integrator(std::string_view name) {
  const auto found = std::ranges::find(table, name, &Integrator::name);
  return found == std::end(table) ? nullptr : &*found;
}

}  // namespace tracer
