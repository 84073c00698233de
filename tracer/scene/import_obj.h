// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "tracer/base/error.h"
#include "tracer/base/progress.h"
#include "tracer/geometry/world_bounds.h"
#include "tracer/scene/scene.h"

namespace tracer {

struct ImportedScene {
  Scene scene;         // smooth where the file has normals, else flat
  WorldBounds bounds;  // of the triangles
  bool has_normals = false;
  uint32_t face_count = 0;    // polygons kept
  int64_t dropped_faces = 0;  // polygons left out
  uint32_t object_count = 0;
  uint32_t group_count = 0;
  size_t dropped_texcoords = 0;  // that no texture is looked up by
  uint64_t file_bytes = 0;
  // That the OBJ names and the scene depends on: material libraries and textures, those that cannot
  // be read too.
  std::vector<std::filesystem::path> files;
  Warnings warnings;
};

/// Reads an OBJ, its material libraries and the textures that used materials name. A path that
/// leads out of the model's folder, or to nothing, stands for the file of that name beside who
/// names it; where there is none, that is a warning. Throws LoadError when there is
/// nothing to show, Cancelled when asked to stop.
ImportedScene import_obj(const std::filesystem::path& path, Progress& progress);

}  // namespace tracer
