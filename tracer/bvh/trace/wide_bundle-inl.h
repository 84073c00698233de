// SPDX-License-Identifier: MIT
// Bundles through a WideTree: boxes are met by all slopes at once, triangles by each group. What
// float arithmetic leaves open is decided by intersect_triangle, ray by ray.
#if defined(TRACER_WIDE_BUNDLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_WIDE_BUNDLE_INL_H
#undef TRACER_WIDE_BUNDLE_INL_H
#else
#define TRACER_WIDE_BUNDLE_INL_H
#endif

#include <algorithm>

#include <hwy/highway.h>

#include "tracer/bvh/trace/bundle_leaf-inl.h"
#include "tracer/bvh/trace/bundle_rays-inl.h"
#include "tracer/bvh/trace/wide_finish-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR

bool ClosestHitsBundle(const WideTree&, std::span<const Ray>, const StopFlag&, std::span<Hit>) {
  return false;
}
bool OccludedBundle(const WideTree&, std::span<const Ray>, const StopFlag&, std::span<uint8_t>) {
  return false;
}

#else

/// The depth at which the rays pass a side of a box: row * inverse + offset.
struct BundlePlane {
  size_t row;
  float inverse;
  float offset;
};

/// Between the greatest of `near` and the least of `far` depths, a ray may be in a box.
struct BundleSlabs {
  BundlePlane near[5];
  BundlePlane far[3];
};

HWY_INLINE BundleSlabs make_slabs(const Bundle& bundle) {
  const size_t width = hn::Lanes(Floats());
  BundleSlabs slabs;
  const auto plane = [&](size_t axis, size_t side, float inverse, float widening) {
    const float offset = -(bundle.point[static_cast<int>(axis)] * inverse);
    const float pad = (8 * u * bundle.reach + 4 * bundle.deviation) * std::abs(inverse);
    return BundlePlane{(2 * axis + side) * width, inverse * widening,
                       widening == 1 ? offset - pad : (offset + pad) * widening};
  };
  const auto near_plane = [&](size_t axis, size_t side, float slope) {
    return plane(axis, side, 1 / slope, 1);
  };
  const auto far_plane = [&](size_t axis, size_t side, float slope) {
    return plane(axis, side, 1 / slope, 1 + 8 * u);
  };
  const size_t behind = bundle.toward < 0 ? 1 : 0;
  slabs.near[4] = near_plane(bundle.axis_z, behind, bundle.toward);
  slabs.far[2] = far_plane(bundle.axis_z, 1 - behind, bundle.toward);
  const auto add_axis = [&](size_t axis, const float* low, const float* high, size_t index) {
    // Away from 0, so that the inverse is moderate, and outward by more than a slope's rounding.
    constexpr float smallest = 0x1p-20f;
    float least = *std::min_element(low, low + bundle.group_count);
    float greatest = *std::max_element(high, high + bundle.group_count);
    least = std::abs(least) < smallest ? -smallest : least - std::abs(least) * 4 * u;
    greatest = std::abs(greatest) < smallest ? smallest : greatest + std::abs(greatest) * 4 * u;
    BundlePlane* near = slabs.near + 2 * index;
    if (greatest > 0) *near++ = near_plane(axis, 0, greatest);
    if (least < 0) *near++ = near_plane(axis, 1, least);
    if (near == slabs.near + 2 * index + 2) {
      slabs.far[index] = slabs.far[2];  // rays to either side: only the depth bounds them
      return;
    }
    *near = near[-1];
    slabs.far[index] = greatest > 0 ? far_plane(axis, 1, least) : far_plane(axis, 0, greatest);
  };
  add_axis(bundle.axis_x, bundle.low_x, bundle.high_x, 0);
  add_axis(bundle.axis_y, bundle.low_y, bundle.high_y, 1);
  return slabs;
}

/// As push_children, for all rays: the nearest is popped first. `most`: the depth to stop at.
HWY_INLINE StackEntry* push_bundle_children(const WideTree& tree, const float* HWY_RESTRICT node,
                                            const BundleSlabs& slabs, float most,
                                            StackEntry* HWY_RESTRICT top) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  const auto depth = [&](const BundlePlane& plane) {
    return hn::MulAdd(hn::Load(d, node + plane.row), hn::Set(d, plane.inverse),
                      hn::Set(d, plane.offset));
  };
  const auto near_x = hn::Max(depth(slabs.near[0]), depth(slabs.near[1]));
  const auto near_y = hn::Max(depth(slabs.near[2]), depth(slabs.near[3]));
  const auto near_z = hn::Max(depth(slabs.near[4]), hn::Zero(d));
  const auto near = hn::Max(hn::Max(near_x, near_y), near_z);
  const auto far = hn::Min(hn::Min(depth(slabs.far[0]), depth(slabs.far[1])),
                           hn::Min(depth(slabs.far[2]), hn::Set(d, most)));
  const uint32_t hit_lanes = bits_of(hn::Le(near, far));
  if (hit_lanes == 0) return top;
  const auto* children = reinterpret_cast<const WideChild*>(node + 6 * width);
  if (tree.is_larger_than_cache) prefetch(tree, children, hit_lanes);
  // The lane in the low bits makes depths unlike each other.
  const hn::RebindToUnsigned<Floats> du;
  const auto keys = hn::Or(hn::And(hn::BitCast(du, near), hn::Set(du, ~15u)), hn::Iota(du, 0));
  alignas(64) uint32_t key[hn::MaxLanes(Floats())];
  hn::Store(keys, du, key);
  StackEntry* const nearest = top + std::popcount(hit_lanes) - 1;
  for (uint32_t bits = hit_lanes; bits != 0; bits &= bits - 1) {
    const int lane = std::countr_zero(bits);
    const uint32_t nearer =
        hit_lanes & bits_of(hn::RebindMask(d, hn::Lt(keys, hn::Set(du, key[lane]))));
    nearest[-std::popcount(nearer)] = {children[lane], key[lane] & ~15u};
  }
  return nearest + 1;
}

/// One bundle on its way.
template <Query query>
class BundleTraversal {
 public:
  BundleTraversal(const WideTree& tree, std::span<const Ray> rays, Bundle& bundle, Hit* hits,
                  uint8_t* is_occluded)
      : tree_(tree), rays_(rays), bundle_(bundle), hits_(hits), is_occluded_(is_occluded) {}

  /// False when it meets so many leaves that the rays had better be traced alone.
  bool run(const StopFlag& stop) {
    size_t leaf_budget = rays_.size() * (query == Query::closest_hit ? 32 : 1);
    const size_t width = hn::Lanes(Floats());
    const BundleSlabs slabs = make_slabs(bundle_);
    const float* const nodes = tree_.nodes.row(0);
    StackEntry stack[stack_capacity];
    StackEntry* top = stack;
    *top++ = {WideChild::node(0), 0};
    find_most();
    while (top != stack) {
      const StackEntry current = *--top;
      if (std::bit_cast<float>(current.entry) > most_) continue;
      if (current.child.is_leaf()) {
        if (stop.requested()) return true;
        if (leaf_budget-- == 0) return false;
        meet_leaf(current.child.index(), stop);
      } else {
        const float* node = nodes + current.child.index() * (WideTree::rows_a_node * width);
        top = push_bundle_children(tree_, node, slabs, most_, top);
      }
    }
    return true;
  }

 private:
  void find_most() {
    most_ = *std::max_element(bundle_.group_most, bundle_.group_most + bundle_.group_count) *
            (1 + 8 * u);
  }

  void meet_leaf(size_t first_block, const StopFlag& stop) {
    const size_t width = hn::Lanes(Floats());
    for (size_t block = first_block;; ++block) {
      if ((block - first_block) % blocks_a_look == blocks_a_look - 1 && stop.requested()) return;
      const WideTree::BlockInfo& info = tree_.block_infos[block];
      const float* rows = tree_.blocks.row(0) + block * (WideTree::rows_a_block * width);
      BlockPlanes planes;
      find_planes(rows, bundle_, planes);
      const uint32_t filled = (2u << (info.count - 1)) - 1;
      for (size_t group = 0; group < bundle_.group_count; ++group) {
        uint32_t lanes = cull(planes, bundle_, group) & filled;
        if (lanes == 0) continue;
        for (; lanes != 0; lanes &= lanes - 1) {
          meet_triangle(planes, block, std::countr_zero(lanes), group);
        }
        update_group(bundle_, group);
      }
      if (info.is_last) break;
    }
    find_most();
  }

  void meet_triangle(const BlockPlanes& planes, size_t block, int lane, size_t group) {
    const Floats d;
    const size_t width = hn::Lanes(d);
    const size_t first = group * width;
    const GroupHits met = meet(planes, lane, bundle_, group);
    if (met.possible == 0) return;
    const uint32_t certain = bits_of(met.certain);
    if (certain != 0) {
      float* const least = bundle_.least + first;
      float* const most = bundle_.most + first;
      if constexpr (query == Query::closest_hit) {
        const hn::RebindToUnsigned<Floats> du;
        uint32_t* const winner = bundle_.winner + first;
        const auto candidate =
            hn::Set(du, static_cast<uint32_t>(block * width + static_cast<size_t>(lane)));
        hn::Store(hn::IfThenElse(met.certain, met.least, hn::Load(d, least)), d, least);
        hn::Store(hn::IfThenElse(met.certain, met.most, hn::Load(d, most)), d, most);
        hn::Store(hn::IfThenElse(hn::RebindMask(du, met.certain), candidate, hn::Load(du, winner)),
                  du, winner);
      } else {
        const auto done = hn::Set(d, nothing_counts);
        hn::Store(hn::IfThenElse(met.certain, done, hn::Load(d, least)), d, least);
        hn::Store(hn::IfThenElse(met.certain, done, hn::Load(d, most)), d, most);
        for (uint32_t bits = certain; bits != 0; bits &= bits - 1) {
          is_occluded_[first + static_cast<size_t>(std::countr_zero(bits))] = 1;
        }
      }
    }
    for (uint32_t bits = met.possible & ~certain; bits != 0; bits &= bits - 1) {
      meet_exactly(block, lane, first + static_cast<size_t>(std::countr_zero(bits)));
    }
  }

  void meet_exactly(size_t block, int lane, size_t ray) {
    const size_t width = hn::Lanes(Floats());
    if (ray >= bundle_.ray_count) return;
    const float* v = tree_.blocks.row(0) + block * (WideTree::rows_a_block * width) + lane;
    const auto vertex = [&](size_t row) {
      return Vec3f(v[row * width], v[(row + 1) * width], v[(row + 2) * width]);
    };
    const auto found = intersect_triangle(rays_[ray], vertex(0), vertex(3), vertex(6));
    if (!found) return;
    if constexpr (query == Query::occluded) {
      is_occluded_[ray] = 1;
      bundle_.least[ray] = bundle_.most[ray] = nothing_counts;
    } else {
      const Hit hit{found->t, found->u, found->v, std::bit_cast<uint32_t>(v[9 * width])};
      if (hit.is_closer_than(hits_[ray])) hits_[ray] = hit;
      const float depth = static_cast<float>(hit.t) * bundle_.speed[ray];
      bundle_.least[ray] = std::min(bundle_.least[ray], depth * (1 - 8 * u) - FLT_MIN);
      bundle_.most[ray] = std::min(bundle_.most[ray], depth * (1 + 8 * u) + FLT_MIN);
    }
  }

  const WideTree& tree_;
  std::span<const Ray> rays_;
  Bundle& bundle_;
  Hit* hits_;  // of what was decided exactly; winners are not in it yet
  uint8_t* is_occluded_;
  float most_ = 0;
};

// NOLINTBEGIN(misc-definitions-in-headers): each instruction set has a namespace of its own.
bool ClosestHitsBundle(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                       std::span<Hit> hits) {
  Bundle bundle;
  if (!gather_from_origin(tree, rays, bundle)) return false;
  std::ranges::fill(hits, Hit{});
  if (!BundleTraversal<Query::closest_hit>(tree, rays, bundle, hits.data(), nullptr).run(stop))
    return false;
  for (size_t first = 0; first < rays.size(); first += hn::Lanes(Doubles())) {
    finish_winners(tree, rays, bundle, first, hits);
  }
  return true;
}

bool OccludedBundle(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                    std::span<uint8_t> is_occluded) {
  Bundle bundle;
  if (!gather_from_end(tree, rays, bundle)) return false;
  std::ranges::fill(is_occluded, uint8_t{0});
  return BundleTraversal<Query::occluded>(tree, rays, bundle, nullptr, is_occluded.data())
      .run(stop);
}
// NOLINTEND(misc-definitions-in-headers)

#endif
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
