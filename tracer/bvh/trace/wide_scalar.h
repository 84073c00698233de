// SPDX-License-Identifier: MIT
// The wide tree met box by box in double, for rays that are out of the SIMD kernels' range.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tracer/bvh/layout/wide_tree.h"
#include "tracer/geometry/box.h"
#include "tracer/geometry/ray.h"

namespace tracer {

namespace wide_scalar_detail {

template <class Intersect>
class Traversal {
 public:
  Traversal(const WideTree& tree, const Ray& ray, Intersect& intersect)
      : tree_(tree), ray_(ray), slabs_(ray), intersect_(intersect) {}

  void find_closest(WideChild place, Hit& best) const {
    if (place.is_leaf()) {
      any_primitive(place.index(), [&](uint32_t primitive) {
        const Hit hit = intersect_(primitive, ray_);
        if (hit.is_hit() && hit.is_closer_than(best)) best = hit;
        return false;
      });
      return;
    }
    Entries entries;
    const std::span<Entry> entered = enter(place.index(), entries);
    std::ranges::sort(entered, {}, &Entry::distance);
    for (const Entry& entry : entered) {
      // Equal distances are visited: the lower primitive may be in the farther child.
      if (entry.distance > best.t) return;
      find_closest(entry.child, best);
    }
  }

  bool find_any(WideChild place) const {
    if (place.is_leaf()) {
      return any_primitive(
          place.index(), [&](uint32_t primitive) { return intersect_(primitive, ray_).is_hit(); });
    }
    Entries entries;
    return std::ranges::any_of(enter(place.index(), entries),
                               [&](const Entry& entry) { return find_any(entry.child); });
  }

 private:
  struct Entry {
    double distance;
    WideChild child;
  };
  using Entries = std::array<Entry, 16>;

  // Those of the node's children whose boxes the ray meets within [t_min, t_max].
  std::span<Entry> enter(uint32_t node, Entries& entries) const {
    const auto width = static_cast<size_t>(tree_.width);
    const float* const rows = tree_.nodes.row(node * WideTree::rows_a_node);
    size_t count = 0;
    for (size_t lane = 0; lane < width; ++lane) {
      const auto at = [&](size_t row) { return rows[row * width + lane]; };
      const Box box{.min = {at(0), at(2), at(4)}, .max = {at(1), at(3), at(5)}};
      // An unused lane: a ray whose slabs are not numbers would enter it, and never come back.
      if (box.is_empty()) continue;
      const auto [entry, exit] = box.intersect(slabs_);
      if (entry > exit || entry > ray_.t_max || exit < ray_.t_min) continue;
      entries[count++] = {entry, WideChild{std::bit_cast<uint32_t>(at(6))}};
    }
    return {entries.data(), count};
  }

  // Whether f(primitive) is true for any of the leaf's; ends at the first.
  template <class F>
  bool any_primitive(uint32_t block, F&& f) const {
    for (;; ++block) {
      const float* const primitives = tree_.blocks.row(block * WideTree::rows_a_block + 9);
      static_assert(WideTree::rows_a_block == 10);  // the last row holds the primitives
      const WideTree::BlockInfo& info = tree_.block_infos[block];
      for (size_t lane = 0; lane < info.count; ++lane) {
        if (f(std::bit_cast<uint32_t>(primitives[lane]))) return true;
      }
      if (info.is_last != 0) return false;
    }
  }

  const WideTree& tree_;
  const Ray& ray_;
  const RaySlabs slabs_;
  Intersect& intersect_;
};

}  // namespace wide_scalar_detail

/// The closest hit within [ray.t_min, ray.t_max], as closest_hit_recursive gives it over the tree
/// that `tree` was collapsed from, with the same Intersect.
template <class Intersect>
Hit closest_hit_scalar(const WideTree& tree, const Ray& ray, Intersect&& intersect) {
  Hit best;
  wide_scalar_detail::Traversal(tree, ray, intersect).find_closest(WideChild::node(0), best);
  return best;
}

/// Whether anything lies within [ray.t_min, ray.t_max].
template <class Intersect>
bool occluded_scalar(const WideTree& tree, const Ray& ray, Intersect&& intersect) {
  return wide_scalar_detail::Traversal(tree, ray, intersect).find_any(WideChild::node(0));
}

}  // namespace tracer
