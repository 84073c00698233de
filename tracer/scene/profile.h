// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "tracer/scene/scene.h"

namespace tracer {

/// What a scene has that costs time where it is looked for.
struct SceneProfile {
  bool has_surface_colors = false;  // textures or colours of vertices, not one a material
  bool has_smooth_normals = false;  // not one a triangle
  bool has_emissive_triangles = false;
  bool has_alpha = false;                         // surfaces that let rays pass
  BsdfFeatures features = BsdfFeatures::diffuse;  // of all surfaces

  /// All surfaces are flat, diffuse, opaque and of one colour a material.
  bool is_plain() const {
    return !has_surface_colors && !has_smooth_normals && !has_alpha &&
           features == BsdfFeatures::diffuse;
  }
};

SceneProfile make_profile(const Scene& scene);

/// Work that a scene does not need, and why.
struct SkippedWork {
  std::string_view what;
  std::string_view why;
};
std::vector<SkippedWork> skipped_work(const SceneProfile& profile);

}  // namespace tracer
