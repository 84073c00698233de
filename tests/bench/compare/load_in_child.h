// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "tests/bench/compare/check_numbers.h"
#include "tests/bench/compare/obj_loaders.h"
#include "tests/bench/compare/options.h"

namespace bench {

/// One load in a process of its own: what was loaded before leaves no heap to it.
struct LoadTime {
  double seconds = 0;
  uint64_t triangles = 0;
};

/// One that is watched meanwhile.
struct LoadMemory {
  size_t mesh_bytes = 0;  // LoadedModel::bytes
  size_t peak_bytes = 0;  // the most memory at any moment, beyond that before and mapped files
  size_t held_bytes = 0;  // of it, what the model takes in the end
  NumberCheck numbers;
};

/// Load in a child process, this program as `load-once` or `load-watched`, on so many threads.
/// Throw std::runtime_error where it fails.
LoadTime time_load(const ObjLoader& loader, const std::filesystem::path& path, int thread_count);
LoadMemory watch_load(const ObjLoader& loader, const std::filesystem::path& path, int thread_count);

/// The child's sides: they print what the others return, as JSON.
int load_once(const Options& options);
int load_watched(const Options& options);

}  // namespace bench
