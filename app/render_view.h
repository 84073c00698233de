// SPDX-License-Identifier: MIT
#pragma once

#include "app/render_command.h"
#include "tracer/render/world.h"
#include "tracer/scene/view_file.h"

namespace app {

/// What is seen, and how large.
struct ResolvedView {
  tracer::Camera camera;
  tracer::Vec2i size_px;
  tracer::Vec3d sky;
  EnvironmentSource environment{};
};

/// The view that was asked for: the options, else the view file that they name or that lies beside
/// the model, else the model framed. Throws LoadError, and OptionError for what cannot be seen.
ResolvedView resolve_view(const RenderOptions& options, const tracer::Mesh& mesh);

}  // namespace app
