// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "tracer/base/error.h"
#include "tracer/base/progress.h"
#include "tracer/obj/obj_file.h"
#include "tracer/scene/scene.h"

namespace tracer {

struct ImportedMaterials {
  std::vector<Material> materials;  // one a name in ObjFile::material_names
  std::vector<Texture> textures;
  std::vector<std::filesystem::path> files;  // of both, those that cannot be read too
  Warnings warnings;                         // of the OBJ, in the order of its lines
  Warnings library_warnings;                 // of what it names
};

/// Reads the material libraries of the OBJ at `model_path` and, each once, the textures of the
/// materials marked in `is_textured`. Never fails: what is missing is a warning, and a material
/// that no library has is the default one. Throws Cancelled.
ImportedMaterials import_materials(const std::filesystem::path& model_path, const ObjFile& file,
                                   const std::vector<bool>& is_textured, Progress& progress);

}  // namespace tracer
