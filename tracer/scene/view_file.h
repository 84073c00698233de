// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "tracer/scene/camera.h"

namespace tracer {

/// Not below 0, and not so large that light sums to infinity in float.
bool is_radiance(const Vec3d& rgb);

/// {"eye":[x,y,z],"target":[..],"up":[..],"fov":degrees,"size":[w,h],"sky":[r,g,b]}; every key but
/// eye and target may be missing.
struct View {
  Camera camera;
  std::optional<Vec2i> size_px;
  std::optional<Vec3d> sky;  // radiance
};

/// Throws LoadError that names the key and what it should be.
View load_view(const std::filesystem::path& path);
void save_view(const std::filesystem::path& path, const View& view);

/// cow.obj -> cow.view.json, beside the model.
std::filesystem::path view_path_of(const std::filesystem::path& model);

}  // namespace tracer
