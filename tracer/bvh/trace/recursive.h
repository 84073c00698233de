// SPDX-License-Identifier: MIT
// The readable reference: recursive traversal that knows only boxes and an intersect function.
#pragma once

#include <utility>

#include "tracer/bvh/tree.h"
#include "tracer/geometry/ray.h"

namespace tracer {

namespace recursive_detail {

template <class Intersect>
class Traversal {
 public:
  Traversal(const BvhTree& tree, const Ray& ray, Intersect& intersect)
      : tree_(tree), ray_(ray), slabs_(ray), intersect_(intersect) {}

  bool enters(const BvhNode& node) const { return is_ahead(node.bounds.intersect(slabs_)); }

  void find_closest(const BvhNode& node, Hit& best) const {
    if (node.is_leaf()) {
      for (uint32_t i = node.first; i < node.first + node.count; ++i) {
        const Hit hit = intersect_(tree_.primitives[i], ray_);
        if (hit.is_hit() && hit.is_closer_than(best)) best = hit;
      }
      return;
    }
    const BvhNode* near = &tree_.nodes[node.first];
    const BvhNode* far = near + 1;
    auto near_span = near->bounds.intersect(slabs_);
    auto far_span = far->bounds.intersect(slabs_);
    if (far_span.first < near_span.first) {
      std::swap(near, far);
      std::swap(near_span, far_span);
    }
    // Equal distances are visited: the lower primitive may be in the far child.
    if (is_ahead(near_span) && near_span.first <= best.t) find_closest(*near, best);
    if (is_ahead(far_span) && far_span.first <= best.t) find_closest(*far, best);
  }

  bool find_any(const BvhNode& node) const {
    if (!enters(node)) return false;
    if (!node.is_leaf()) {
      return find_any(tree_.nodes[node.first]) || find_any(tree_.nodes[node.first + 1]);
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (intersect_(tree_.primitives[i], ray_).is_hit()) return true;
    }
    return false;
  }

 private:
  // Whether [entry, exit] is no miss and reaches into [t_min, t_max].
  bool is_ahead(const std::pair<double, double>& span) const {
    return span.first <= span.second && span.first <= ray_.t_max && span.second >= ray_.t_min;
  }

  const BvhTree& tree_;
  const Ray& ray_;
  const RaySlabs slabs_;
  Intersect& intersect_;
};

}  // namespace recursive_detail

/// The closest hit within [ray.t_min, ray.t_max], t_min >= 0. Intersect is
/// Hit(uint32_t primitive, const Ray&): a hit in that range, or one without a primitive for a miss.
template <class Intersect>
Hit closest_hit_recursive(const BvhTree& tree, const Ray& ray, Intersect&& intersect) {
  Hit best;
  if (tree.nodes.empty()) return best;
  const recursive_detail::Traversal traversal(tree, ray, intersect);
  if (traversal.enters(tree.nodes[0])) traversal.find_closest(tree.nodes[0], best);
  return best;
}

/// Whether anything lies within [ray.t_min, ray.t_max], t_min >= 0.
template <class Intersect>
bool occluded_recursive(const BvhTree& tree, const Ray& ray, Intersect&& intersect) {
  if (tree.nodes.empty()) return false;
  return recursive_detail::Traversal(tree, ray, intersect).find_any(tree.nodes[0]);
}

}  // namespace tracer
