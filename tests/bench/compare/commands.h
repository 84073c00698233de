// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "tests/bench/compare/options.h"

namespace bench {

// Each measures, prints a table, writes its files into options.folder and prints their paths.
// Returns the exit code: 0, or 1 where answers were wrong or nothing could be measured.

int compare_rays(const Options& options);
int compare_builds(const Options& options);
int measure_orbit(const Options& options);
int compare_kernels(const Options& options);
int measure_exactness(const Options& options);
int compare_errors(const Options& options);
int compare_loads(const Options& options);
int measure_launch(const Options& options);

struct Command {
  std::string_view name;  // as on the command line
  std::string_view what;  // empty: of no use to a user
  int (*run)(const Options& options);
};

std::span<const Command> commands();

}  // namespace bench
