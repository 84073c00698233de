// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tracer/bvh/build.h"
#include "tracer/bvh/trace/accel.h"

namespace app {

/// Which tree, and how rays go through it.
struct TreeKey {
  const tracer::Builder* builder = &tracer::builders().front();  // nullptr: none, brute force
  const tracer::Layout* layout = &tracer::layouts().front();
  tracer::BuildSettings settings;
  int improvement_rounds = 0;  // of re-insertion, at most, before it is laid out
};

/// Whether both ask for the same tree; without a builder nothing else matters.
bool is_same_tree(const TreeKey& a, const TreeKey& b);

/// Builds what `key` asks for over the mesh. Throws Cancelled.
std::shared_ptr<const tracer::Accel> build_accel(std::shared_ptr<const tracer::Mesh> mesh,
                                                 const TreeKey& key, tracer::Progress& progress);

}  // namespace app
