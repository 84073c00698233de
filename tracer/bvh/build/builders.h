// SPDX-License-Identifier: MIT
// The functions in the table of builders.
#pragma once

#include "tracer/bvh/build.h"

namespace tracer {

/// Halves the node's box across its longest side; primitives go left or right by their centre.
/// Where all go to one side, halves the bounds of the centres instead, and where the centres
/// coincide, the primitives by number. [Assignment 2006] 3.2 e
BvhTree build_median(const Primitives& primitives, const BuildSettings& settings,
                     Progress& progress);

/// Tries every plane between two centres on all three axes and takes the one of least surface area
/// cost, the most even of equals; presorted, so O(n log n). [Wald 2007] Nodes above the leaf size
/// are always split while the depth allows. Where the levels left would otherwise not reach the
/// leaf size, only planes that keep it in reach are tried.
BvhTree build_sweep_sah(const Primitives& primitives, const BuildSettings& settings,
                        Progress& progress);

/// Tries the planes between equal bins over the bounds of the centres on all three axes, and below
/// a few dozen primitives every plane; the most even of equals. [Wald 2007] Leaves and depth as
/// build_sweep_sah.
BvhTree build_binned_sah(const Primitives& primitives, const BuildSettings& settings,
                         Progress& progress);

/// Sorts the centres along a Z-order curve and splits where the highest bit of their codes changes
/// [Lauterbach 2009]; primitives in one cell of the curve are sorted along one of their own. Leaves
/// and depth as build_sweep_sah.
BvhTree build_morton(const Primitives& primitives, const BuildSettings& settings,
                     Progress& progress);

}  // namespace tracer
