// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "tracer/base/progress.h"
#include "tracer/bvh/tree.h"
#include "tracer/geometry/mesh.h"

namespace tracer {

/// Everything that answers a ray: a mesh, and a tree over its triangles or none. Without a tree
/// each ray meets every triangle. Both answer with the same bits.
struct Accel {
  std::shared_ptr<const Mesh> mesh;
  std::optional<BvhTree> tree;
};

/// Answers the rays of one tile or one test on one thread, and counts them. When `stop` is
/// requested, answers may be misses: the caller looks at the flag before it keeps a result.
class RayCaster {
 public:
  RayCaster(const Accel& accel, const StopFlag& stop) : accel_(accel), stop_(stop) {}

  Hit closest_hit(const Ray& ray);
  bool occluded(const Ray& ray);

  uint64_t ray_count() const { return ray_count_; }
  bool is_stopped() const { return stop_.requested(); }

 private:
  const Accel& accel_;
  const StopFlag& stop_;
  uint64_t ray_count_ = 0;
};

}  // namespace tracer
