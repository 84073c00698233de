// SPDX-License-Identifier: MIT
// Rays without anything in common, several under way at a time: each takes a step in turn and asks
// for what its next one needs, so that memory answers while the others work.
#if defined(TRACER_WIDE_FLIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_WIDE_FLIGHT_INL_H
#undef TRACER_WIDE_FLIGHT_INL_H
#else
#define TRACER_WIDE_FLIGHT_INL_H
#endif

#include <span>

#include <hwy/highway.h>

#include "tracer/bvh/trace/wide_traverse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR

size_t ClosestHitsInFlight(const WideTree&, std::span<const Ray>, const StopFlag&, std::span<Hit>) {
  return 0;
}

#else

/// One ray under way.
class Flight {
 public:
  /// False for a ray out of the filter's range or in need of Slabs::exact.
  bool start(const WideTree& tree, const Ray& ray) {
    if (!prepare(tree, ray, constants_) || constants_.is_far_reaching) return false;
    ray_ = &ray;
    top_ = stack_;
    current_ = {WideChild::node(0), std::bit_cast<uint32_t>(constants_.t_min)};
    best_ = {};
    t_far_ = round_up(ray.t_max) * (1 + 8 * u);
    return true;
  }

  const Hit& best() const { return best_; }
  const Ray* ray() const { return ray_; }

  /// One node or leaf. False when there is none left.
  bool step(const WideTree& tree, const StopFlag& stop) {
    if (current_.child.is_leaf()) {
      meet_leaf(tree, stop);
    } else {
      const size_t width = hn::Lanes(Floats());
      const float* node =
          tree.nodes.row(0) + current_.child.index() * (WideTree::rows_a_node * width);
      top_ = push_children<Slabs::fused, true>(tree, node, constants_, t_far_, top_);
    }
    do {
      if (top_ == stack_) return false;
      current_ = *--top_;
    } while (std::bit_cast<float>(current_.entry) > t_far_);
    prefetch(tree, &current_.child, 1);
    return true;
  }

 private:
  void meet_leaf(const WideTree& tree, const StopFlag& stop) {
    const size_t width = hn::Lanes(Floats());
    const size_t first_block = current_.child.index();
    const float entry = std::bit_cast<float>(current_.entry);
    for (size_t block = first_block;; ++block) {
      if ((block - first_block) % blocks_a_look == blocks_a_look - 1 && stop.requested()) return;
      const WideTree::BlockInfo& info = tree.block_infos[block];
      const float* rows = tree.blocks.row(0) + block * (WideTree::rows_a_block * width);
      const BlockHits hits =
          hit_triangles<Query::closest_hit, Slabs::fused>(rows, info, constants_, entry, t_far_);
      for (uint32_t bits = hits.possible; bits != 0; bits &= bits - 1) {
        const float* v = rows + std::countr_zero(bits);
        const auto vertex = [&](size_t row) {
          return Vec3f(v[row * width], v[(row + 1) * width], v[(row + 2) * width]);
        };
        const auto found = intersect_triangle(*ray_, vertex(0), vertex(3), vertex(6));
        if (!found) continue;
        const Hit hit{found->t, found->u, found->v, std::bit_cast<uint32_t>(v[9 * width])};
        if (!hit.is_closer_than(best_)) continue;
        best_ = hit;
        t_far_ = std::min(t_far_, round_up(hit.t) * (1 + 8 * u));
      }
      if (info.is_last) return;
    }
  }

  RayConstants constants_;
  const Ray* ray_;
  Hit best_;
  float t_far_;
  StackEntry current_;
  StackEntry* top_;
  StackEntry stack_[stack_capacity];
};

// NOLINTBEGIN(misc-definitions-in-headers): each instruction set has a namespace of its own.
size_t ClosestHitsInFlight(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                           std::span<Hit> hits) {
  constexpr size_t flight_count = 8;
  Flight all[flight_count];
  Flight* flights[flight_count];
  size_t next = 0;  // rays before it are answered or under way
  bool is_open = true;
  const auto start_next = [&](Flight& flight) {
    is_open = is_open && next < rays.size() && !stop.requested() && flight.start(tree, rays[next]);
    if (is_open) ++next;
    return is_open;
  };
  size_t under_way = 0;
  while (under_way < flight_count && start_next(all[under_way])) {
    flights[under_way] = &all[under_way];
    ++under_way;
  }
  while (under_way > 0) {
    for (size_t i = 0; i < under_way;) {
      Flight& flight = *flights[i];
      if (flight.step(tree, stop)) {
        ++i;
        continue;
      }
      hits[static_cast<size_t>(flight.ray() - rays.data())] = flight.best();
      if (!start_next(flight)) flights[i] = flights[--under_way];
    }
  }
  return next;
}
// NOLINTEND(misc-definitions-in-headers)

#endif
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
