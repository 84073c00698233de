// SPDX-License-Identifier: MIT
// Boxwood and other loaders of OBJ files, asked alike.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tracer/base/vectors.h"

namespace bench {

/// What a loader made of a file of triangles; its memory is let go with this.
struct LoadedModel {
  uint64_t triangle_count = 0;
  size_t bytes = 0;  // of the arrays of triangles and their corners; 0 where it is not known
  /// Corner 0 to 2 of a triangle, in the order of the file's faces, as the loader keeps it:
  /// relative to `origin`.
  std::function<tracer::Vec3f(uint64_t triangle, int corner)> corner;
  tracer::Vec3d origin{0.0};
};

struct ObjLoader {
  std::string name;
  int most_threads = 1;  // that it makes use of
  /// Throws std::runtime_error where the file cannot be loaded.
  LoadedModel (*load)(const std::filesystem::path& path) = nullptr;

  bool is_ours() const { return name == "boxwood"; }
};

/// Boxwood first, then those that this build found.
const std::vector<ObjLoader>& obj_loaders();

/// Names and packages of those that it did not find.
std::vector<std::string> missing_obj_loaders();

}  // namespace bench
