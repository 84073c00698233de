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
#include <bit>
#include <type_traits>

#include <hwy/highway.h>

#include "tracer/bvh/trace/bundle_leaf-inl.h"
#include "tracer/bvh/trace/bundle_rays-inl.h"
#include "tracer/bvh/trace/wide_finish-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR

BundleVerdicts ClosestHitsBundles(const WideTree&, std::span<const Ray>, size_t, const StopFlag&,
                                  std::span<Hit>) {
  return {};
}
BundleVerdicts OccludedBundles(const WideTree&, std::span<const Ray>, size_t, const StopFlag&,
                               std::span<uint8_t>) {
  return {};
}

#else

/// The depth at which the rays pass a side of a box: (row - origin) * inverse + pad.
struct BundlePlane {
  size_t row;
  float origin;
  float inverse;
  float pad;
};

/// Between the greatest of `near` and the least of `far` depths, a ray may be in a box.
struct BundleSlabs {
  BundlePlane near[5];
  BundlePlane far[3];
};

HWY_INLINE BundleSlabs make_slabs(const Bundle& bundle) {
  const size_t width = hn::Lanes(Floats());
  BundleSlabs slabs;
  // Errors are relative to the depth; what underflows rounds absolutely.
  const auto plane = [&](size_t axis, size_t side, float inverse, float widening) {
    const float pad = 4 * bundle.deviation * std::abs(inverse) + FLT_MIN;
    return BundlePlane{(2 * axis + side) * width, bundle.point[static_cast<int>(axis)],
                       inverse * widening, widening == 1 ? -pad : pad * widening};
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
HWY_INLINE StackEntry* push_bundle_children(const float* HWY_RESTRICT node,
                                            const BundleSlabs& slabs, float most,
                                            StackEntry* HWY_RESTRICT top) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  const auto depth = [&](const BundlePlane& plane) {
    return hn::MulAdd(hn::Sub(hn::Load(d, node + plane.row), hn::Set(d, plane.origin)),
                      hn::Set(d, plane.inverse), hn::Set(d, plane.pad));
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

/// One bundle on its way, a node or a leaf a step.
template <Query query>
class BundleTraversal {
 public:
  using Answer = std::conditional_t<query == Query::closest_hit, Hit, uint8_t>;
  enum class State { under_way, answered, given_up };

  /// False where the rays make no bundle.
  bool start(const WideTree& tree, std::span<const Ray> rays, size_t leaves_a_ray,
             std::span<Answer> answers) {
    const bool is_bundle = query == Query::closest_hit ? gather_from_origin(tree, rays, bundle_)
                                                       : gather_from_end(tree, rays, bundle_);
    if (!is_bundle) return false;
    tree_ = &tree;
    rays_ = rays;
    answers_ = answers.data();
    std::ranges::fill(answers, Answer{});
    slabs_ = make_slabs(bundle_);
    leaf_budget_ = leaves_a_ray * rays.size();
    find_most();
    current_ = {WideChild::node(0), 0};
    top_ = stack_;
    return true;
  }

  State step(const StopFlag& stop) {
    if (current_.child.is_leaf()) {
      if (stop.requested()) return State::answered;
      if (leaf_budget_-- == 0) return State::given_up;
      meet_leaf(current_.child.index(), stop);
    } else {
      const size_t width = hn::Lanes(Floats());
      const float* node =
          tree_->nodes.row(0) + current_.child.index() * (WideTree::rows_a_node * width);
      top_ = push_bundle_children(node, slabs_, most_, top_);
    }
    do {
      if (top_ == stack_) return State::answered;
      current_ = *--top_;
    } while (std::bit_cast<float>(current_.entry) > most_);
    return State::under_way;
  }

  /// Asks for what the next step needs.
  void fetch() const { prefetch(*tree_, &current_.child, 1); }

  /// Rays that follow once this is answered: each call asks for some of them.
  void set_upcoming(std::span<const Ray> rays) { upcoming_ = std::as_bytes(rays); }
  void fetch_upcoming() {
    constexpr size_t line = 64, lines_a_call = 4;
    for (size_t i = 0; i < lines_a_call && !upcoming_.empty(); ++i) {
      hwy::Prefetch(upcoming_.data());
      upcoming_ = upcoming_.subspan(std::min(line, upcoming_.size()));
    }
  }

  void finish() {
    if constexpr (query == Query::closest_hit) {
      for (size_t first = 0; first < rays_.size(); first += hn::Lanes(Doubles())) {
        finish_winners(*tree_, rays_, bundle_, first, {answers_, rays_.size()});
      }
    }
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
      const WideTree::BlockInfo& info = tree_->block_infos[block];
      const float* rows = tree_->blocks.row(0) + block * (WideTree::rows_a_block * width);
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
          answers_[first + static_cast<size_t>(std::countr_zero(bits))] = 1;
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
    const float* v = tree_->blocks.row(0) + block * (WideTree::rows_a_block * width) + lane;
    const Hit hit = hit_exactly(v, width, rays_[ray]);
    if (!hit.is_hit()) return;
    if constexpr (query == Query::occluded) {
      answers_[ray] = 1;
      bundle_.least[ray] = bundle_.most[ray] = nothing_counts;
    } else {
      if (hit.is_closer_than(answers_[ray])) answers_[ray] = hit;
      const float depth = static_cast<float>(hit.t) * bundle_.speed[ray];
      bundle_.least[ray] = std::min(bundle_.least[ray], depth * (1 - 8 * u) - FLT_MIN);
      bundle_.most[ray] = std::min(bundle_.most[ray], depth * (1 + 8 * u) + FLT_MIN);
    }
  }

  const WideTree* tree_;
  std::span<const Ray> rays_;
  std::span<const std::byte> upcoming_;
  Answer* answers_;  // of closest hits, what was decided exactly; winners are not in it yet
  Bundle bundle_;
  BundleSlabs slabs_;
  size_t leaf_budget_;
  float most_;
  StackEntry current_;
  StackEntry* top_;
  StackEntry stack_[stack_capacity];
};

/// `together` bundles take a step in turn, so that one waits for memory while others work. With
/// one, each takes over the memory of that before it, which is in a cache.
template <Query query, size_t together>
BundleVerdicts answer_bundles(const WideTree& tree, std::span<const Ray> rays, size_t leaves_a_ray,
                              const StopFlag& stop,
                              std::span<typename BundleTraversal<query>::Answer> answers) {
  using State = typename BundleTraversal<query>::State;
  BundleTraversal<query> bundles[together];
  uint32_t under_way = 0;
  BundleVerdicts verdicts;
  const auto step = [&](size_t i) {
    BundleTraversal<query>& bundle = bundles[i % together];
    bundle.fetch_upcoming();
    const State state = bundle.step(stop);
    if (state == State::under_way) return true;
    if (state == State::answered) bundle.finish();
    (state == State::answered ? verdicts.answered : verdicts.given_up) |= 1u << i;
    return false;
  };
  for (size_t i = 0; i * bundle_size < answers.size(); ++i) {
    const size_t first = i * bundle_size;
    const size_t count = std::min(bundle_size, answers.size() - first);
    const bool is_bundle = bundles[i % together].start(tree, rays.subspan(first, count),
                                                       leaves_a_ray, answers.subspan(first, count));
    if (!is_bundle) continue;
    const size_t next = std::min(first + together * bundle_size, rays.size());
    bundles[i % together].set_upcoming(
        rays.subspan(next, std::min(bundle_size, rays.size() - next)));
    if constexpr (together == 1) {
      while (step(i)) {
      }
    } else {
      under_way |= 1u << i;
    }
  }
  while (under_way != 0) {
    for (uint32_t bits = under_way; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<size_t>(std::countr_zero(bits));
      if (step(i)) {
        bundles[i % together].fetch();
      } else {
        under_way &= ~(1u << i);
      }
    }
  }
  return verdicts;
}

template <Query query, class Answer>
BundleVerdicts answer_bundles(const WideTree& tree, std::span<const Ray> rays, size_t leaves_a_ray,
                              const StopFlag& stop, std::span<Answer> answers) {
  return tree.is_larger_than_cache
             ? answer_bundles<query, bundles_under_way>(tree, rays, leaves_a_ray, stop, answers)
             : answer_bundles<query, 1>(tree, rays, leaves_a_ray, stop, answers);
}

// NOLINTBEGIN(misc-definitions-in-headers): each instruction set has a namespace of its own.
BundleVerdicts ClosestHitsBundles(const WideTree& tree, std::span<const Ray> rays,
                                  size_t leaves_a_ray, const StopFlag& stop, std::span<Hit> hits) {
  return answer_bundles<Query::closest_hit>(tree, rays, leaves_a_ray, stop, hits);
}

BundleVerdicts OccludedBundles(const WideTree& tree, std::span<const Ray> rays, size_t leaves_a_ray,
                               const StopFlag& stop, std::span<uint8_t> is_occluded) {
  return answer_bundles<Query::occluded>(tree, rays, leaves_a_ray, stop, is_occluded);
}
// NOLINTEND(misc-definitions-in-headers)

#endif
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
