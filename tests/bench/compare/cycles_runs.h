// SPDX-License-Identifier: MIT
// Blender's Cycles, where it is installed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/compare/error_runs.h"

namespace bench {

struct Blender {
  std::filesystem::path program;
  std::string version;  // "Blender 3.4.1"
};

/// Nothing where there is none.
std::optional<Blender> find_blender();

/// Pictures of 1, 2, 4 ... samples a pixel, until one takes `longest_seconds`, on all processors.
/// Their seconds are of rendering alone: what a picture of no samples would take is fitted and
/// taken away. Throws std::runtime_error.
std::vector<Snapshot> render_with_cycles(const Blender& blender, const ErrorScene& scene, int seed,
                                         double longest_seconds);

}  // namespace bench
