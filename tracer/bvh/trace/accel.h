// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "tracer/base/progress.h"
#include "tracer/bvh/layout/wide_tree.h"
#include "tracer/bvh/tree.h"
#include "tracer/geometry/mesh.h"

namespace tracer {

/// Everything that answers a ray, and no more: a mesh, and a tree over its triangles in one form or
/// none. Without a tree each ray meets every triangle. All ways answer with the same bits.
struct Accel {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const BvhTree> tree = nullptr;   // as the recursive reference takes it
  std::shared_ptr<const WideTree> wide = nullptr;  // as the SIMD kernels take it

  bool has_tree() const { return tree || wide; }
  /// Of the tree, beside the mesh.
  size_t bytes() const { return (tree ? tree->bytes() : 0) + (wide ? wide->bytes() : 0); }
};

/// A way to lay out and traverse a tree. To add one: its files, and one line in accel.cpp.
struct Layout {
  std::string_view name;   // as on the command line
  std::string_view label;  // as in the panel
  std::string_view what;   // one sentence
  void (*lay_out)(Accel& accel, Progress& progress);
};

/// The first is the default.
std::span<const Layout> layouts();
/// nullptr when there is none of that name.
const Layout* find_layout(std::string_view name);

/// `tree` is over primitive_boxes(*mesh); nullptr for brute force. Kept only where rays are traced
/// through it: whoever needs it for anything else shares it. Throws Cancelled.
Accel make_accel(std::shared_ptr<const Mesh> mesh, std::shared_ptr<const BvhTree> tree,
                 const Layout& layout, Progress& progress);
/// The same for a tree that nobody shares; nullopt for brute force.
Accel make_accel(std::shared_ptr<const Mesh> mesh, std::optional<BvhTree> tree,
                 const Layout& layout, Progress& progress);

/// Bundles are tried seldom where more than a few were given up.
class BundleTries {
 public:
  bool skips_next() { return to_skip_ > 0 && to_skip_-- > 0; }
  void note(int answered_count, int given_up_count);

 private:
  unsigned failures_ = 0;  // in a row
  unsigned to_skip_ = 0;
};

/// Answers the rays of one tile or one test on one thread, and counts them. When `stop` is
/// requested, answers may be misses: the caller looks at the flag before it keeps a result.
class RayCaster {
 public:
  RayCaster(const Accel& accel, const StopFlag& stop) : accel_(accel), stop_(stop) {}

  Hit closest_hit(const Ray& ray);
  bool occluded(const Ray& ray);

  /// The same hits, in the order of the rays, sooner: rays from one origin are traced as bundles
  /// where 64 neighbours in the span look about the same way (a square of pixels does), and rays
  /// that start all over a large scene several at a time.
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits);
  /// 1 for rays that meet anything, else 0; sooner where neighbours end in one point.
  void occluded(std::span<const Ray> rays, std::span<uint8_t> is_occluded);

  uint64_t ray_count() const { return ray_count_; }

 private:
  const Accel& accel_;
  const StopFlag& stop_;
  uint64_t ray_count_ = 0;
  BundleTries hit_tries_, occlusion_tries_;
};

}  // namespace tracer
