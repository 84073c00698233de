// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "tracer/bvh/build.h"

namespace app {

struct InfoOptions {
  enum class Format { table, json };
  std::filesystem::path model;
  Format format = Format::table;
  // Whose trees are measured; may be none.
  std::vector<const tracer::Builder*> builders{&tracer::builders().front()};
  tracer::BuildSettings build;
};

/// Prints what is in an OBJ, and how good trees over it are, to stdout; returns the exit code.
/// Throws LoadError.
int info_command(const InfoOptions& options);

}  // namespace app
