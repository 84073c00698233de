// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

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

/// What rays are traced through, and beside it the binary tree that it was made of, for whoever
/// improves or measures that.
struct BuiltAccel {
  std::shared_ptr<const tracer::Accel> accel;
  std::shared_ptr<const tracer::BvhTree> tree;  // nullptr without a builder
};

/// Builds what `key` asks for over the mesh. Throws Cancelled.
BuiltAccel build_accel(const std::shared_ptr<const tracer::Mesh>& mesh, const TreeKey& key,
                       tracer::Progress& progress);
/// Lays out a binary tree over the mesh, or none. Throws Cancelled.
BuiltAccel lay_out(const std::shared_ptr<const tracer::Mesh>& mesh,
                   std::optional<tracer::BvhTree> tree, const tracer::Layout& layout,
                   tracer::Progress& progress);

}  // namespace app
