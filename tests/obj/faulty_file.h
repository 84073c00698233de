// SPDX-License-Identifier: MIT
// A model that is not as it should be: what must be left of it, and what must be said.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/run_program.h"
#include "tracer/base/error.h"
#include "tracer/scene/import_obj.h"

namespace tests {

/// One fault as the user reads it: "model.obj:5: vertex 9 does not exist ...".
struct ExpectedFault {
  int64_t line = 0;
  std::string reason;  // part of it
};

struct FaultyFile {
  std::string what;
  std::string bytes;
  uint32_t triangles = 0;     // 0: nothing can be shown
  int64_t dropped_faces = 0;  // of models that can be shown
  std::vector<ExpectedFault> faults;
  int64_t fault_count = -1;  // of warnings in all; -1: as many as `faults`

  int64_t warning_count() const {
    return fault_count < 0 ? static_cast<int64_t>(faults.size()) : fault_count;
  }
};

/// What the loader makes of the file, or the fault that ends it.
struct Loading {
  std::optional<tracer::ImportedScene> scene;
  std::string error;
};
Loading load(const std::filesystem::path& path);

/// Expects, of the loader and of the program, what the file says of itself: triangles and warnings
/// with their lines and exit code 0, or one line and exit code 2.
void expect_as_described(const FaultyFile& file);

/// Expects one line on standard error that has `reason`, and exit code 2, of loader and program.
void expect_refused(const std::filesystem::path& path, const std::string& reason);

/// The mean of all triangles' normals, weighted by area: its length is the area of a flat model
/// whose triangles all turn one way.
tracer::Vec3d summed_area(const tracer::Mesh& mesh);
/// Of all triangles, whichever way they turn.
double total_area(const tracer::Mesh& mesh);

}  // namespace tests
