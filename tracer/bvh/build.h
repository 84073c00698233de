// SPDX-License-Identifier: MIT
// The table of builders. To add one: one file in build/, one line in build.cpp.
#pragma once

#include <span>
#include <string_view>

#include "tracer/base/progress.h"
#include "tracer/bvh/build_settings.h"
#include "tracer/bvh/primitives.h"
#include "tracer/bvh/tree.h"

namespace tracer {

/// Builds a tree. The result is the same at any number of threads. Throws Cancelled when `progress`
/// is asked to stop.
using BuildFunction = BvhTree (*)(const Primitives& primitives, const BuildSettings& settings,
                                  Progress& progress);

struct Builder {
  std::string_view name;   // as on the command line
  std::string_view label;  // as in the panel
  std::string_view what;   // one sentence
  BuildFunction build;
};

/// The first is the default.
std::span<const Builder> builders();
/// nullptr when there is none of that name.
const Builder* find_builder(std::string_view name);

}  // namespace tracer
