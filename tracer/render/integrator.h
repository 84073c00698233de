// SPDX-License-Identifier: MIT
// The table of integrators. To add one: one file, one line in integrator.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tracer/render/render_settings.h"
#include "tracer/render/sampler.h"
#include "tracer/render/world.h"

namespace tracer {

/// A camera ray and what it meets first, traced together with its neighbours'.
struct CameraHit {
  Ray ray;
  Hit hit;
};

/// Radiance, linear RGB, that arrives along a camera ray: one sample.
using RadianceFunction = Vec3d (*)(const World& world, RayCaster& rays, const CameraHit& camera,
                                   Sampler& sampler, const RenderSettings& settings);

/// The same sample, with its path appended to `text`, a line a vertex.
using DescribeFunction = Vec3d (*)(const World& world, RayCaster& rays, const CameraHit& camera,
                                   Sampler& sampler, const RenderSettings& settings,
                                   std::string& text);

struct Integrator {
  std::string_view name;   // as on the command line
  std::string_view label;  // as in the panel
  std::string_view what;   // one sentence
  RadianceFunction radiance;
  DescribeFunction describe;
};

/// The first is the default.
std::span<const Integrator> integrators();
/// nullptr when there is none of that name.
const Integrator* find_integrator(std::string_view name);

}  // namespace tracer
