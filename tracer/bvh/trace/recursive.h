// SPDX-License-Identifier: MIT
// The readable reference: recursive traversal that knows only boxes and an intersect function.
#pragma once

#include <utility>

#include "tracer/bvh/tree.h"
#include "tracer/geometry/ray.h"

namespace tracer {

// Intersect: Hit(uint32_t primitive, const Ray&), no_primitive in it for a miss.

namespace recursive_detail {

template <class Intersect>
void closest_hit(const BvhTree& tree, const BvhNode& node, const Ray& ray, Intersect& intersect,
                 Hit& best) {
  if (node.is_leaf()) {
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Hit hit = intersect(tree.primitives[i], ray);
      if (hit.is_hit() && hit.is_closer_than(best)) best = hit;
    }
    return;
  }
  const BvhNode* near = &tree.nodes[node.first];
  const BvhNode* far = near + 1;
  auto [near_entry, near_exit] = near->bounds.intersect(ray);
  auto [far_entry, far_exit] = far->bounds.intersect(ray);
  if (far_entry < near_entry) {
    std::swap(near, far);
    std::swap(near_entry, far_entry);
    std::swap(near_exit, far_exit);
  }
  // Equal distances are visited: the lower primitive may be in the far child.
  if (near_entry <= near_exit && near_entry <= best.t && near_entry <= ray.t_max) {
    closest_hit(tree, *near, ray, intersect, best);
  }
  if (far_entry <= far_exit && far_entry <= best.t && far_entry <= ray.t_max) {
    closest_hit(tree, *far, ray, intersect, best);
  }
}

template <class Intersect>
bool occluded(const BvhTree& tree, const BvhNode& node, const Ray& ray, Intersect& intersect) {
  const auto [entry, exit] = node.bounds.intersect(ray);
  if (!(entry <= exit) || entry > ray.t_max) return false;
  if (node.is_leaf()) {
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (intersect(tree.primitives[i], ray).is_hit()) return true;
    }
    return false;
  }
  return occluded(tree, tree.nodes[node.first], ray, intersect) ||
         occluded(tree, tree.nodes[node.first + 1], ray, intersect);
}

}  // namespace recursive_detail

/// The closest hit within [ray.t_min, ray.t_max]; intersect(primitive, ray) returns a Hit in that
/// range or a miss.
template <class Intersect>
Hit closest_hit_recursive(const BvhTree& tree, const Ray& ray, Intersect&& intersect) {
  Hit best;
  if (tree.nodes.empty()) return best;
  const auto [entry, exit] = tree.nodes[0].bounds.intersect(ray);
  if (entry <= exit && entry <= ray.t_max) {
    recursive_detail::closest_hit(tree, tree.nodes[0], ray, intersect, best);
  }
  return best;
}

/// Whether anything lies within [ray.t_min, ray.t_max].
template <class Intersect>
bool occluded_recursive(const BvhTree& tree, const Ray& ray, Intersect&& intersect) {
  return !tree.nodes.empty() && recursive_detail::occluded(tree, tree.nodes[0], ray, intersect);
}

}  // namespace tracer
