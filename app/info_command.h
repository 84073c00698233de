// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace app {

struct InfoOptions {
  enum class Format { table, json };
  std::filesystem::path model;
  Format format = Format::table;
};

/// Prints what is in an OBJ to stdout; returns the exit code. Throws LoadError.
int info_command(const InfoOptions& options);

}  // namespace app
