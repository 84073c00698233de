// SPDX-License-Identifier: MIT
// The table of builders. To add one: one file in build/, one line in build.cpp.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "tracer/base/progress.h"
#include "tracer/bvh/build_settings.h"
#include "tracer/bvh/tree.h"

namespace tracer {

/// All that a builder knows of what it sorts: boxes[i] contains primitive i; all finite and not
/// empty; fewer than 2^31.
struct Primitives {
  std::span<const Box> boxes;
  /// The box of the part of a primitive that lies in `within`, never smaller than it; empty where
  /// there is no such part. Callable from many threads. No function: nothing can be cut.
  std::function<Box(uint32_t primitive, const Box& within)> clip;

  Primitives(std::span<const Box> all_boxes) : boxes(all_boxes) {}
  Primitives(const std::vector<Box>& all_boxes) : boxes(all_boxes) {}
};

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
