// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/base/progress.h"
#include "tracer/bvh/build_settings.h"
#include "tracer/bvh/tree.h"

namespace tracer {

/// One round of re-insertion: each node is taken out with all below it and put where it enlarges
/// the boxes above it least, those that gain most first [Bittner 2013], as far as they don't touch
/// the same nodes [Meister 2018b]. The result has the same leaves, a lower surface area cost and no
/// more depth than settings.max_depth (or `tree`) has; it is `tree` again where the cost would not
/// fall. The same at any number of threads. Throws Cancelled.
BvhTree reinsert(const BvhTree& tree, const BuildSettings& settings, Progress& progress);

}  // namespace tracer
