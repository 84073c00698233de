// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/compare/options.h"

namespace bench {

// Each measures, prints a table, writes its files into options.folder and prints their paths.
// Returns the exit code: 0, or 1 where answers were wrong or nothing could be measured.

int compare_rays(const Options& options);
int compare_builds(const Options& options);
int measure_orbit(const Options& options);

}  // namespace bench
