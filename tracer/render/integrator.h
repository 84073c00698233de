// SPDX-License-Identifier: MIT
// The table of integrators. To add one: one file, one line in integrator.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "tracer/render/render_settings.h"
#include "tracer/render/sampler.h"
#include "tracer/render/world.h"

namespace tracer {

/// Samples of neighbouring pixels, answered together so that their rays can be traced together. All
/// spans are of one size, 1 to max_size; a sample's radiance does not depend on the others.
struct SampleBlock {
  static constexpr size_t max_size = 64;

  std::span<const Ray> camera_rays;
  std::span<const Hit> camera_hits;  // what those meet first
  std::span<Sampler> samplers;       // the random numbers that follow the camera's
  std::span<Vec3d> radiance;         // the answer: linear RGB that arrives along each ray

  size_t size() const { return camera_rays.size(); }
};

using RadianceFunction = void (*)(const World& world, RayCaster& rays,
                                  const RenderSettings& settings, const SampleBlock& block);

/// The same for a block of one, with its path appended to `text`, a line a vertex.
using DescribeFunction = void (*)(const World& world, RayCaster& rays,
                                  const RenderSettings& settings, const SampleBlock& block,
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
