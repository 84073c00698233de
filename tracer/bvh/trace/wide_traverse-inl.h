// SPDX-License-Identifier: MIT
// Traversal of a WideTree, compiled once for each instruction set. A float filter with a proved
// bound passes over boxes and triangles that the ray certainly misses; what is left is decided by
// intersect_triangle, so the bits are those of the reference. docs/numerics.md derives the bounds.
#if defined(TRACER_WIDE_TRAVERSE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_WIDE_TRAVERSE_INL_H
#undef TRACER_WIDE_TRAVERSE_INL_H
#else
#define TRACER_WIDE_TRAVERSE_INL_H
#endif

#include <algorithm>
#include <bit>
#include <span>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "tracer/bvh/build_settings.h"
#include "tracer/bvh/trace/exact_lanes-inl.h"
#include "tracer/bvh/trace/wide_kernels.h"
#include "tracer/bvh/trace/wide_leaf-inl.h"
#include "tracer/geometry/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

// No kernel: a width of 0 says so, and nobody calls the others.
inline int KernelWidth() {
  return 0;
}
inline bool ClosestHit(const WideTree&, const Ray&, const StopFlag&, Hit&) {
  return false;
}
inline bool Occluded(const WideTree&, const Ray&, const StopFlag&, Hit&) {
  return false;
}
inline bool CountClosestHit(const WideTree&, const Ray&, const StopFlag&, Hit&, VisitCounts&) {
  return false;
}
inline bool CountOccluded(const WideTree&, const Ray&, const StopFlag&, Hit&, VisitCounts&) {
  return false;
}

#else

constexpr int stack_capacity = max_tree_depth * 16;
// Of one leaf, between two looks at the stop flag: some 10 microseconds.
constexpr size_t blocks_a_look = 256;

struct StackEntry {
  WideChild child;
  uint32_t entry;  // bits of a distance >= 0, which order as the distances do
};

/// Asks for what the children lead to, so that it is near when they are popped.
HWY_INLINE void prefetch(const WideTree& tree, const WideChild* children, uint32_t bits) {
  const size_t width = hn::Lanes(Floats());
  for (; bits != 0; bits &= bits - 1) {
    const WideChild child = children[std::countr_zero(bits)];
    const bool is_leaf = child.is_leaf();
    const size_t row_count = is_leaf ? WideTree::rows_a_block : WideTree::rows_a_node;
    const float* rows =
        (is_leaf ? tree.blocks : tree.nodes).row(0) + child.index() * row_count * width;
    for (size_t line = 0; line < row_count * width; line += 16) hwy::Prefetch(rows + line);
    if (is_leaf) hwy::Prefetch(&tree.block_infos[child.index()]);
  }
}

HWY_INLINE void sort_two(uint32_t& a, uint32_t& b) {
  const uint32_t less = std::min(a, b);
  b = std::max(a, b);
  a = less;
}

/// Steps to the nearest of the children that the ray may meet before t_far and pushes the others,
/// so that the next nearest is popped first, or in any order unless `is_sorted`. False if there
/// are none.
template <Slabs slabs, bool is_sorted>
HWY_INLINE bool descend(const WideTree& tree, const float* HWY_RESTRICT node, const RayConstants& c,
                        float t_far, StackEntry& current, StackEntry* HWY_RESTRICT& top) {
  const Floats d;
  const hn::RebindToUnsigned<Floats> du;
  const auto [near, is_hit] = hit_slabs<slabs>(node, c, t_far);
  uint32_t bits = bits_of(is_hit);
  if (bits == 0) return false;

  const auto* children = reinterpret_cast<const WideChild*>(node + 6 * hn::Lanes(d));
  // The lane in the low bits makes distances unlike each other; entries are kept without it, so
  // that they are never too large.
  const auto keys = hn::Or(hn::And(hn::BitCast(du, near), hn::Set(du, ~15u)), hn::Iota(du, 0));
  const auto entry_of = [&](uint32_t key) { return StackEntry{children[key & 15], key & ~15u}; };
  alignas(64) uint32_t key[hn::MaxLanes(Floats())];
  hn::Store(keys, du, key);
  // Where the lane is known its child need not wait for the key.
  const auto entry_in = [&](int lane) { return StackEntry{children[lane], key[lane] & ~15u}; };
  const int first = std::countr_zero(bits);
  uint32_t rest = bits & (bits - 1);
  if (rest == 0) {
    current = entry_in(first);
    return true;
  }
  if constexpr (!is_sorted) {
    current = entry_in(first);
    for (; rest != 0; rest &= rest - 1) *top++ = entry_in(std::countr_zero(rest));
    return true;
  }
  if (tree.is_larger_than_cache) prefetch(tree, children, bits);
  const int count = std::popcount(bits);
  if (count == 2) {
    const int second = std::countr_zero(rest);
    const bool is_first_nearer = key[first] < key[second];
    *top++ = entry_in(is_first_nearer ? second : first);
    current = entry_in(is_first_nearer ? first : second);
    return true;
  }
  if (count <= 4) {
    alignas(64) uint32_t hit_key[hn::MaxLanes(Floats())];
    hn::Store(hn::Compress(keys, hn::RebindMask(du, is_hit)), du, hit_key);
    uint32_t a = hit_key[0], b = hit_key[1], c3 = hit_key[2];
    sort_two(a, b);
    if (count == 4) {
      uint32_t d4 = hit_key[3];
      sort_two(c3, d4);
      sort_two(b, d4);
      *top++ = entry_of(d4);
    }
    sort_two(a, c3);
    sort_two(b, c3);
    top[0] = entry_of(c3);
    top[1] = entry_of(b);
    top += 2;
    current = entry_of(a);
    return true;
  }
  // Each lane's place is the number of hit lanes that are nearer.
  const uint32_t hit_lanes = bits;
  StackEntry* const nearest = top + count - 1;
  for (; bits != 0; bits &= bits - 1) {
    const int lane = std::countr_zero(bits);
    const uint32_t nearer =
        hit_lanes & bits_of(hn::RebindMask(d, hn::Lt(keys, hn::Set(du, key[lane]))));
    nearest[-std::popcount(nearer)] = entry_in(lane);
  }
  current = *nearest;
  top = nearest;
  return true;
}

/// Probes watch a traversal; this one sees nothing and costs nothing.
struct NoProbe {
  void node() {}
  void block(const WideTree::BlockInfo&) {}
  void exact_test() {}
};

struct CountingProbe {
  VisitCounts& counts;

  void node() { ++counts.nodes; }
  void block(const WideTree::BlockInfo& info) {
    ++counts.blocks;
    counts.triangles += info.count;
  }
  void exact_test() { ++counts.exact_tests; }
};

HWY_INLINE uint32_t primitive_in(const float* HWY_RESTRICT rows, int lane) {
  return std::bit_cast<uint32_t>(rows[9 * hn::Lanes(Floats()) + static_cast<size_t>(lane)]);
}

/// Of the triangle in the lane that begins at `v`, of a block of `width` lanes; no hit for a miss.
/// Not inlined: beside it the usual case would load one by one what it can broadcast from memory.
HWY_NOINLINE inline Hit hit_exactly(const float* HWY_RESTRICT v, size_t width, const Ray& ray) {
  const auto vertex = [&](size_t row) {
    return Vec3f(v[row * width], v[(row + 1) * width], v[(row + 2) * width]);
  };
  const auto found = exact_triangle::intersect(ray, vertex(0), vertex(3), vertex(6));
  if (!found) return {};
  return {found->t, found->u, found->v, std::bit_cast<uint32_t>(v[9 * width])};
}

/// A triangle that a ray may hit: a lane of a block's rows.
template <class Found>
struct Candidate {
  const Ray* ray;
  const float* rows;
  const Found* found;
  int lane;
};

/// hit_exactly() of each candidate, as many as there are doubles in a vector at most.
template <Query query, class Found>
HWY_INLINE void hit_together(std::span<const Candidate<Found> > candidates,
                             Hit* HWY_RESTRICT hits) {
  const Doubles d;
  const size_t width = hn::Lanes(Floats());
  const auto triangle_of = [&](const Candidate<Found>& candidate) {
    return candidate.rows + candidate.lane;
  };
  CornerLanes corners{};
  CornerLanes ray_parts{};  // origin and direction
  for (size_t i = 0; i < candidates.size(); ++i) {
    const float* v = triangle_of(candidates[i]);
    const Ray& ray = *candidates[i].ray;
    for (size_t row = 0; row < 9; ++row) corners.rows[row][i] = v[row * width];
    for (int k = 0; k < 3; ++k) {
      ray_parts.rows[k][i] = ray.origin[k];
      ray_parts.rows[3 + k][i] = ray.direction[k];
    }
  }
  const TriangleHitLanes found =
      intersect_triangles(ray_parts.corner(0), ray_parts.corner(1), corners.corner(0),
                          corners.corner(1), corners.corner(2));
  alignas(64) double t[hn::MaxLanes(d)], weight1[hn::MaxLanes(d)], weight2[hn::MaxLanes(d)];
  hn::Store(found.t, d, t);
  if constexpr (query == Query::closest_hit) {
    hn::Store(found.u, d, weight1);
    hn::Store(found.v, d, weight2);
  }
  const uint32_t certain = bits_of(d, found.is_certain), hit = bits_of(d, found.is_hit);
  for (size_t i = 0; i < candidates.size(); ++i) {
    const Candidate<Found>& candidate = candidates[i];
    if (HWY_UNLIKELY((certain >> i & 1) == 0)) {
      hits[i] = hit_exactly(triangle_of(candidate), width, *candidate.ray);
    } else if ((hit >> i & 1) != 0 && t[i] >= candidate.ray->t_min &&
               t[i] <= candidate.ray->t_max) {
      hits[i].primitive = std::bit_cast<uint32_t>(triangle_of(candidate)[9 * width]);
      if constexpr (query == Query::closest_hit) {
        hits[i].t = t[i];
        hits[i].u = weight1[i];
        hits[i].v = weight2[i];
      }
    }
  }
}

/// The triangles of a block, decided exactly. Benchmarks traverse with leaves of other kinds.
struct ExactLeaf {
  using Found = FilteredHits;

  template <Query query, Slabs slabs, Flow flow>
  static HWY_INLINE Found find(const float* HWY_RESTRICT rows, const WideTree::BlockInfo& info,
                               const RayConstants& c, const Ray&, float entry,
                               const HitRange& range) {
    return filter_hits<query, slabs, flow>(rows, info, c, entry, range);
  }
  /// Of a lane that is possible.
  static HWY_INLINE Hit hit(const float* HWY_RESTRICT rows, const Found&, int lane,
                            const Ray& ray) {
    const float* v = rows + lane;
    const size_t width = hn::Lanes(Floats());
    if constexpr (has_four_doubles) {
      const CertainTriangleHit found = intersect_certainly(ray, v, width);
      if (HWY_LIKELY(found.is_certain)) {
        if (!found.is_hit || !(found.t >= ray.t_min && found.t <= ray.t_max)) return {};
        return {found.t, found.u, found.v, std::bit_cast<uint32_t>(v[9 * width])};
      }
    }
    return hit_exactly(v, width, ray);
  }
  /// Of no more than `tests_together`; `hits` are none before.
  static constexpr size_t tests_together = hn::MaxLanes(Doubles());
  template <Query query>
  static HWY_INLINE void hits(std::span<const Candidate<Found> > candidates, Hit* hits) {
    hit_together<query>(candidates, hits);
  }
};

/// What is asked of the hit, part by part: wider loads would wait for the stores of the parts.
template <Query query>
HWY_INLINE void keep(const Hit& hit, Hit& best) {
  best.primitive = hit.primitive;
  if constexpr (query == Query::closest_hit) {
    best.t = hit.t;
    best.u = hit.u;
    best.v = hit.v;
  }
}

template <Query query, Slabs slabs, class Leaf, class Probe>
HWY_NOINLINE void traverse(const WideTree& tree, const Ray& ray, const RayConstants& constants,
                           const StopFlag& stop, Probe probe, Hit& best) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  const float* const nodes = tree.nodes.row(0);
  const float* const blocks = tree.blocks.row(0);
  const WideTree::BlockInfo* const infos = tree.block_infos.data();
  StackEntry stack[stack_capacity];
  StackEntry* top = stack;
  StackEntry current{WideChild::node(0), std::bit_cast<uint32_t>(constants.t_min)};
  HitRange range = hit_range<query>(constants, ray);
  for (;;) {
    while (!current.child.is_leaf()) {
      probe.node();
      const float* node = nodes + current.child.index() * (WideTree::rows_a_node * width);
      if (descend<slabs, query == Query::closest_hit>(tree, node, constants, range.t_far, current,
                                                      top))
        continue;
      do {
        if (top == stack) return;
        current = *--top;
      } while (std::bit_cast<float>(current.entry) > range.t_far);
    }
    const float entry = std::bit_cast<float>(current.entry);
    if (entry <= range.t_far) {
      const size_t first_block = current.child.index();
      for (size_t block = first_block;; ++block) {
        if ((block - first_block) % blocks_a_look == blocks_a_look - 1 && stop.requested()) return;
        const WideTree::BlockInfo& info = infos[block];
        probe.block(info);
        const float* rows = blocks + block * (WideTree::rows_a_block * width);
        const auto hits = Leaf::template find<query, slabs, Flow::leaves_early>(
            rows, info, constants, ray, entry, range);
        if constexpr (query == Query::occluded) {
          if (hits.certain != 0) {
            best.primitive = primitive_in(rows, std::countr_zero(hits.certain));
            return;
          }
        }
        for (uint32_t bits = hits.possible; bits != 0; bits &= bits - 1) {
          probe.exact_test();
          const Hit hit = Leaf::hit(rows, hits, std::countr_zero(bits), ray);
          if (!hit.is_hit()) continue;
          if constexpr (query == Query::occluded) {
            keep<query>(hit, best);
            return;
          }
          if (hit.is_closer_than(best)) {
            keep<query>(hit, best);
            range.t_far = std::min(range.t_far, stop_at(constants, hit.t));
          }
        }
        if (info.is_last) break;
      }
    }
    do {
      if (top == stack) return;
      current = *--top;
    } while (std::bit_cast<float>(current.entry) > range.t_far);
  }
}

/// False for a ray out of the filter's range.
template <Query query, class Leaf = ExactLeaf, class Probe>
HWY_INLINE bool answer(const WideTree& tree, const Ray& ray, const StopFlag& stop, Probe probe,
                       Hit& hit) {
  RayConstants constants;
  if (HWY_UNLIKELY(!prepare(tree, ray, constants))) return false;
  with_slabs(constants, [&]<Slabs slabs>() {
    traverse<query, slabs, Leaf>(tree, ray, constants, stop, probe, hit);
  });
  return true;
}

// NOLINTBEGIN(misc-definitions-in-headers): each instruction set has a namespace of its own.
inline int KernelWidth() {
  return static_cast<int>(hn::Lanes(Floats()));
}

inline bool ClosestHit(const WideTree& tree, const Ray& ray, const StopFlag& stop, Hit& hit) {
  return answer<Query::closest_hit>(tree, ray, stop, NoProbe{}, hit);
}

inline bool Occluded(const WideTree& tree, const Ray& ray, const StopFlag& stop, Hit& hit) {
  return answer<Query::occluded>(tree, ray, stop, NoProbe{}, hit);
}

inline bool CountClosestHit(const WideTree& tree, const Ray& ray, const StopFlag& stop, Hit& hit,
                            VisitCounts& counts) {
  return answer<Query::closest_hit>(tree, ray, stop, CountingProbe{counts}, hit);
}

inline bool CountOccluded(const WideTree& tree, const Ray& ray, const StopFlag& stop, Hit& hit,
                          VisitCounts& counts) {
  return answer<Query::occluded>(tree, ray, stop, CountingProbe{counts}, hit);
}
// NOLINTEND(misc-definitions-in-headers)

#endif

}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
