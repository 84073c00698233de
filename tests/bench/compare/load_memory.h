// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "tests/bench/compare/check_numbers.h"
#include "tests/bench/compare/obj_loaders.h"
#include "tests/bench/compare/options.h"

namespace bench {

/// One load in a process of its own.
struct LoadOnce {
  uint64_t triangles = 0;
  size_t mesh_bytes = 0;  // LoadedModel::bytes
  size_t peak_bytes = 0;  // the most memory at any moment, beyond that before and mapped files
  size_t held_bytes = 0;  // of it, what the model takes in the end
  NumberCheck numbers;
};

/// Loads in a child process, this program as `load-once`, on so many threads. Throws
/// std::runtime_error where it fails.
LoadOnce load_in_child(const ObjLoader& loader, const std::filesystem::path& path,
                       int thread_count);

/// The child's side: prints a LoadOnce as JSON.
int load_once(const Options& options);

}  // namespace bench
