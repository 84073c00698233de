// SPDX-License-Identifier: MIT
// The table of scenes that ray tracers are compared on.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "tracer/geometry/mesh.h"

namespace bench {

/// What to trace, from where, and a point light for its shadows.
struct Scene {
  std::string_view name;
  std::shared_ptr<const tracer::Mesh> mesh;
  tracer::Vec3f eye;
  tracer::Vec3f target;
  tracer::Vec3f light;
};

/// quick: generated scenes have a tenth of their triangles.
enum class Effort { full, quick };

struct SceneEntry {
  std::string_view name;  // as on the command line
  std::string_view what;
  bool is_in_quick;  // whether a quick run takes it unasked
  /// Nothing where its file is missing.
  std::optional<Scene> (*make)(std::string_view name, Effort effort);
};

std::span<const SceneEntry> scene_entries();

}  // namespace bench
