// SPDX-License-Identifier: MIT
#include "tracer/scene/profile.h"

namespace tracer {
SceneProfile make_profile(const Scene& scene) {
  return {.has_surface_colors = !scene.mesh->colors.empty() || !scene.textures->empty(),
          .has_smooth_normals = scene.shading == Shading::smooth,
          .has_emissive_triangles = !scene.lights->empty() || scene.surfaces.has_shining_textures,
          .has_alpha = scene.surfaces.has_alpha,
          .features = scene.surfaces.features};
}

std::vector<SkippedWork> skipped_work(const SceneProfile& profile) {
  std::vector<SkippedWork> skipped;
  if (!profile.has_surface_colors) {
    skipped.push_back({"colours at each hit", "no textures, no colours of vertices"});
  }
  if (!profile.has_smooth_normals) {
    skipped.push_back({"normals at each hit", "triangles are shaded flat"});
  }
  const auto lacks = [&](BsdfFeatures part) { return !has(profile.features, part); };
  if (lacks(BsdfFeatures::reflection)) {
    skipped.push_back({"highlights", "no metal, no dielectric that reflects"});
  }
  if (lacks(BsdfFeatures::layers)) skipped.push_back({"layers", "no clear coat, no sheen"});
  if (lacks(BsdfFeatures::transmission)) {
    skipped.push_back({"light through surfaces", "nothing transmits"});
  }
  if (!profile.has_alpha) skipped.push_back({"opacity at each hit", "no ray passes a surface"});
  if (profile.is_plain()) {
    skipped.push_back({"shading one path at a time", "all surfaces are plain"});
  }
  if (!profile.has_emissive_triangles) {
    skipped.push_back({"shadow rays, and hits of last segments", "no triangle emits"});
  }
  skipped.push_back(
      {"camera rays of blocks of pixels that cannot meet the model", "its bounds are known"});
  return skipped;
}

}  // namespace tracer
