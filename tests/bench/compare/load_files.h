// SPDX-License-Identifier: MIT
// OBJ files to be loaded: one of the shared models, and large ones that are made.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tests/support/temporary_folder.h"
#include "tracer/geometry/mesh.h"

namespace bench {

struct LoadFile {
  std::string_view name;  // as on the command line
  std::string_view what;
  bool is_in_quick = false;
  /// Of a full run's --repeats rounds, how many: a small file takes more, a huge one fewer.
  double rounds_a_repeat = 1;
  /// Its path, in the folder where it has to be written; nothing where it is missing.
  std::optional<std::filesystem::path> (*make)(const tracer::TemporaryFolder& folder) = nullptr;
};

std::span<const LoadFile> load_files();

enum class CornerContent { positions, positions_texcoords_normals };

/// Writes a mesh's triangles with 6 decimals a coordinate, and texture coordinates and normals made
/// up for its positions. Throws std::runtime_error where the disk is full.
void write_obj(const std::filesystem::path& path, const tracer::Mesh& mesh, CornerContent content);

}  // namespace bench
