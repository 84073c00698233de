// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "app/environment_source.h"
#include "tracer/bvh/build.h"
#include "tracer/render/aov.h"
#include "tracer/render/integrator.h"
#include "tracer/scene/camera.h"

namespace app {

/// What `boxwood render` was asked for. What is not set comes from the view file, then from the
/// model.
struct RenderOptions {
  std::filesystem::path model;
  std::optional<std::filesystem::path> output;
  std::vector<const tracer::Aov*> aovs;  // in the layers of an EXR

  std::optional<int> sample_count;  // a pixel
  std::optional<double> seconds;    // instead of a sample_count
  std::optional<double> error;      // relMSE at which to stop, if neither of those comes before
  std::optional<tracer::Vec2i> size_px;
  const tracer::Integrator* integrator = &tracer::integrators().front();
  tracer::RenderSettings render;

  std::optional<std::filesystem::path> view_file;
  std::optional<tracer::Vec3d> eye;
  std::optional<tracer::Vec3d> target;
  std::optional<tracer::Vec3d> up;
  std::optional<double> fov_degrees;
  std::optional<tracer::Vec3d> sky;
  EnvironmentSource environment;

  const tracer::Builder* builder = &tracer::builders().front();  // nullptr: brute force
  const tracer::Layout* layout = &tracer::layouts().front();
  tracer::BuildSettings build;
  int improvement_rounds = 0;
  int thread_count = 0;  // 0: all there are

  std::optional<tracer::Vec2i> pixel;  // describe one sample of it
  uint32_t sample = 0;

  std::optional<std::filesystem::path> stats_file;
  bool is_quiet = false;
};

inline constexpr int default_sample_count = 64;
inline constexpr tracer::Vec2i default_size_px{1280, 720};

/// Renders to a file, or tells one sample of one pixel on stdout; returns the exit code. Throws
/// OptionError and LoadError.
int render_command(const RenderOptions& options);

}  // namespace app
