// SPDX-License-Identifier: MIT
// Whether a loader's coordinates are the floats nearest to the decimals in the file.
#pragma once

#include <cstdint>
#include <filesystem>

#include "tests/bench/compare/obj_loaders.h"

namespace bench {

struct NumberCheck {
  uint64_t checked = 0;
  uint64_t wrong = 0;

  double wrong_per_million() const {
    return checked == 0 ? 0 : 1e6 * static_cast<double>(wrong) / static_cast<double>(checked);
  }
};

/// Compares the bits of all coordinates of triangles evenly spread over the file, a million
/// coordinates at most, with strtof's; a loader that moves the model by an origin is held to the
/// float nearest to the difference instead. The file holds triangles with positive indices, faces
/// after all vertices.
NumberCheck check_numbers(const std::filesystem::path& path, const LoadedModel& model);

}  // namespace bench
