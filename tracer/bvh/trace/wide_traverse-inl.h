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

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstring>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "tracer/bvh/build_settings.h"
#include "tracer/bvh/trace/wide_kernels.h"
#include "tracer/geometry/triangle.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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

enum class Query { closest_hit, occluded };

using Floats = hn::CappedTag<float, 16>;
using Lanes = hn::Vec<Floats>;

constexpr float u = 0x1p-24f;  // half an ulp of 1
// Between them no product of the filter over or underflows.
constexpr float least_coordinate = 0x1p-36f;
constexpr float greatest_coordinate = 0x1p36f;
constexpr int stack_capacity = max_tree_depth * 16;
// Of one leaf, between two looks at the stop flag: some 10 microseconds.
constexpr size_t blocks_a_look = 256;

/// How the distance of a plane is computed. With one instruction, and an error relative to all
/// coordinates of the scene; or with two, and an error relative to that distance: for rays in
/// scenes much larger than their leaves.
enum class Slabs { fused, exact };

/// What of a ray the slab tests and the triangle filter need, computed once.
struct RayConstants {
  // One lane an axis, and one unused.
  alignas(16) float inverse[4];
  alignas(16) float near_offset[4];  // Slabs::fused: plane * inverse + offset,
  alignas(16) float far_offset[4];   // the near one at most and the far one at least as far
  alignas(16) float origin[4];       // Slabs::exact: (plane - origin) * inverse, within `pad` and
  alignas(16) float pad[4];          // 3u relative
  alignas(16) uint32_t near_row[4];  // of a node, in floats: min, or max for a negative direction
  alignas(16) uint32_t far_row[4];
  uint32_t row_x, row_y, row_z;  // of a vertex in a block; z: the direction's largest component
  float origin_x, origin_y, origin_z;
  float shear_x, shear_y;
  float toward;             // sign of the largest component
  float largest_component;  // its size
  bool is_far_reaching;     // Slabs::exact pays
  float slack;              // how far outside its box the padded slabs let a ray pass, at most
  float t_min;              // rounded down
};

HWY_INLINE float round_up(double value) {
  const float rounded = static_cast<float>(value);
  return static_cast<double>(rounded) < value ? std::nextafterf(rounded, FLT_MAX * 2) : rounded;
}

/// Whether the ray is in the filter's range.
HWY_INLINE bool prepare(const WideTree& tree, const Ray& ray, RayConstants& c) {
  const auto width = static_cast<uint32_t>(hn::Lanes(Floats()));
  const hn::FixedTag<float, 4> d4;
  const hn::RebindToUnsigned<decltype(d4)> du4;
  const Vec3f& o = ray.origin;
  const Vec3f& direction = ray.direction;
  // In registers: a load of what was stored in smaller parts would wait for the stores.
  const auto lanes = [&](const Vec3f& v, float unused) {
    return hn::ConcatLowerLower(d4, hn::InterleaveLower(d4, hn::Set(d4, v.z), hn::Set(d4, unused)),
                                hn::InterleaveLower(d4, hn::Set(d4, v.x), hn::Set(d4, v.y)));
  };
  const auto origin = lanes(o, 0);
  const auto component = lanes(direction, greatest_coordinate);
  const auto size = hn::Abs(component);

  // Of all coordinates that meet in a slab test.
  const float reach =
      std::max(std::max(std::abs(o.x), std::abs(o.y)), std::abs(o.z)) + tree.max_coordinate;
  const float size_x = std::abs(direction.x), size_y = std::abs(direction.y);
  const float size_z = std::abs(direction.z), size_xy = std::max(size_x, size_y);
  c.largest_component = std::max(size_xy, size_z);
  // Not ">=": NaN is out of range.
  if (!(reach > least_coordinate && reach < greatest_coordinate &&
        c.largest_component < greatest_coordinate && c.largest_component > least_coordinate))
    return false;
  auto inverse = hn::Div(hn::Set(d4, 1.0f), component);
  // A component so small that it moves the ray by less than the slack within the scene counts as
  // this small, and its slab is widened to last for all distances that matter.
  const auto smallest = hn::Set(d4, 0x1p-40f * c.largest_component);
  const auto is_parallel = hn::Lt(size, smallest);
  const bool has_parallel = !hn::AllFalse(d4, is_parallel);
  if (HWY_UNLIKELY(has_parallel)) {
    inverse = hn::Div(hn::Set(d4, 1.0f), hn::CopySign(hn::Max(size, smallest), component));
  }
  c.slack = 32 * u * reach;
  c.is_far_reaching = c.slack > tree.typical_extent * 0x1p-6f;
  const auto wide_pad = hn::Mul(hn::Abs(inverse), hn::Set(d4, 16 * u * reach));
  if (HWY_LIKELY(!c.is_far_reaching)) {
    const auto offset = hn::Neg(hn::Mul(origin, inverse));
    const auto pad = hn::IfThenElse(is_parallel, wide_pad, hn::Mul(wide_pad, hn::Set(d4, 0.5f)));
    hn::Store(hn::Sub(offset, pad), d4, c.near_offset);
    hn::Store(hn::Add(offset, pad), d4, c.far_offset);
  } else {
    const auto least_pad = hn::Set(d4, FLT_MIN);  // what underflows rounds absolutely
    if (!has_parallel) c.slack = 0;
    hn::Store(origin, d4, c.origin);
    hn::Store(hn::IfThenElse(is_parallel, wide_pad, least_pad), d4, c.pad);
  }
  hn::Store(inverse, d4, c.inverse);
  const auto min_row = hn::Mul(hn::Iota(du4, 0), hn::Set(du4, 2 * width));
  const auto max_row = hn::Add(min_row, hn::Set(du4, width));
  const auto is_negative = hn::MaskFromVec(hn::BitCast(
      du4, hn::BroadcastSignBit(hn::BitCast(hn::RebindToSigned<decltype(d4)>(), component))));
  hn::Store(hn::IfThenElse(is_negative, max_row, min_row), du4, c.near_row);
  hn::Store(hn::IfThenElse(is_negative, min_row, max_row), du4, c.far_row);

  // Without branches: the largest component of random rays is not to be foreseen.
  const int z = size_z > size_xy ? 2 : static_cast<int>(size_y > size_x);
  constexpr uint8_t next[3] = {1, 2, 0};
  const int x = next[z];
  const int y = next[x];
  c.row_x = static_cast<uint32_t>(x) * width;
  c.row_y = static_cast<uint32_t>(y) * width;
  c.row_z = static_cast<uint32_t>(z) * width;
  c.origin_x = o[x];
  c.origin_y = o[y];
  c.origin_z = o[z];
  c.shear_x = direction[x] * c.inverse[z];
  c.shear_y = direction[y] * c.inverse[z];
  c.toward = std::copysign(1.0f, direction[z]);
  const auto t_min = static_cast<float>(ray.t_min);
  c.t_min = std::max(0.0f, t_min - std::abs(t_min) * 2 * u);
  return true;
}

/// Lane i of the mask as bit i. Loads what was stored, no more, so that the store is forwarded.
HWY_INLINE uint32_t bits_of(const hn::Mask<Floats>& mask) {
  uint8_t bytes[8];
  hn::StoreMaskBits(Floats(), mask, bytes);
  if constexpr (hn::MaxLanes(Floats()) <= 8) return bytes[0];
  uint16_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

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
    for (size_t line = 0; line < WideTree::rows_a_node * width; line += 16)
      hwy::Prefetch(rows + line);
    if (is_leaf) hwy::Prefetch(&tree.block_infos[child.index()]);
  }
}

/// Pushes the children whose boxes the ray may meet before t_far, so that the nearest is popped
/// first if `is_sorted`. t_far: the distance to stop at, times 1 + 8u.
template <Slabs slabs, bool is_sorted>
HWY_INLINE StackEntry* push_children(const WideTree& tree, const float* HWY_RESTRICT node,
                                     const RayConstants& c, float t_far,
                                     StackEntry* HWY_RESTRICT top) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  const auto plane = [&](uint32_t row, int axis, float sign) {
    const auto position = hn::Load(d, node + row);
    const auto inverse = hn::Set(d, c.inverse[axis]);
    if constexpr (slabs == Slabs::fused) {
      const float offset = (sign < 0 ? c.near_offset : c.far_offset)[axis];
      return hn::MulAdd(position, inverse, hn::Set(d, offset));
    } else {
      const auto distance = hn::Sub(position, hn::Set(d, c.origin[axis]));
      return hn::MulAdd(distance, inverse, hn::Set(d, sign * c.pad[axis]));
    }
  };
  const auto near_plane = [&](int axis) { return plane(c.near_row[axis], axis, -1); };
  const auto far_plane = [&](int axis) { return plane(c.far_row[axis], axis, 1); };
  const auto near =
      hn::Max(hn::Max(near_plane(0), near_plane(1)), hn::Max(near_plane(2), hn::Set(d, c.t_min)));
  const auto far =
      hn::Min(hn::Min(far_plane(0), far_plane(1)), hn::Min(far_plane(2), hn::Set(d, t_far)));
  const auto widest = slabs == Slabs::fused ? far : hn::Mul(far, hn::Set(d, 1 + 8 * u));
  uint32_t bits = bits_of(hn::Le(near, widest));
  if (bits == 0) return top;

  const auto* children = reinterpret_cast<const WideChild*>(node + 6 * width);
  // The lane in the low bits makes distances unlike each other; entries are kept without it, so
  // that they are never too large.
  const hn::RebindToUnsigned<Floats> du;
  const auto keys = hn::Or(hn::And(hn::BitCast(du, near), hn::Set(du, ~15u)), hn::Iota(du, 0));
  alignas(64) uint32_t key[hn::MaxLanes(Floats())];
  hn::Store(keys, du, key);
  const auto entry_of = [&](int lane) { return StackEntry{children[lane], key[lane] & ~15u}; };
  const int first = std::countr_zero(bits);
  uint32_t rest = bits & (bits - 1);
  if (rest == 0) {
    *top = entry_of(first);
    return top + 1;
  }
  if constexpr (!is_sorted) {
    for (; bits != 0; bits &= bits - 1) {
      const int lane = std::countr_zero(bits);
      *top++ = entry_of(lane);
    }
    return top;
  }
  if (tree.is_larger_than_cache) prefetch(tree, children, bits);
  const int second = std::countr_zero(rest);
  rest &= rest - 1;
  if (rest == 0) {
    const bool is_first_nearer = key[first] < key[second];
    const int nearer = is_first_nearer ? first : second;
    const int farther = is_first_nearer ? second : first;
    top[0] = entry_of(farther);
    top[1] = entry_of(nearer);
    return top + 2;
  }
  // Each lane's place is the number of hit lanes that are nearer.
  const uint32_t hit_lanes = bits;
  StackEntry* const nearest = top + std::popcount(bits) - 1;
  for (; bits != 0; bits &= bits - 1) {
    const int lane = std::countr_zero(bits);
    const uint32_t nearer =
        hit_lanes & bits_of(hn::RebindMask(d, hn::Lt(keys, hn::Set(du, key[lane]))));
    nearest[-std::popcount(nearer)] = entry_of(lane);
  }
  return nearest + 1;
}

/// Lanes of a block that the ray may hit, and of those the lanes that it certainly hits at a
/// distance that counts.
struct BlockHits {
  uint32_t possible;
  uint32_t certain;
};

/// The sheared edge functions [Woop 2013] of the float-rounded vertices, with `bound` at least
/// their error.
template <Query query, Slabs slabs>
HWY_INLINE BlockHits hit_triangles(const float* HWY_RESTRICT block, const WideTree::BlockInfo& info,
                                   const RayConstants& c, float entry, float t_far) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  // Both hold for every vertex of a leaf whose padded box the ray meets at `entry`.
  const float path = entry * c.largest_component;
  const float extent = slabs == Slabs::fused
                           ? info.extent + c.slack
                           : (info.extent + c.slack) * (1 + 64 * u) + 32 * u * path;
  const float distance = path + extent;
  const float spread = 4 * extent;
  const float vertex_error = 10 * u * distance;
  const float bound =
      1.0625f * (spread * (2 * vertex_error + 4 * u * spread) + 2 * vertex_error * vertex_error) +
      FLT_MIN;  // products below it round absolutely

  const auto origin_x = hn::Set(d, c.origin_x);
  const auto origin_y = hn::Set(d, c.origin_y);
  const auto origin_z = hn::Set(d, c.origin_z);
  const auto shear_x = hn::Set(d, c.shear_x);
  const auto shear_y = hn::Set(d, c.shear_y);
  Lanes x[3], y[3], z[3];
  for (size_t corner = 0; corner < 3; ++corner) {
    const float* rows = block + 3 * corner * width;
    z[corner] = hn::Sub(hn::Load(d, rows + c.row_z), origin_z);
    x[corner] = hn::NegMulAdd(shear_x, z[corner], hn::Sub(hn::Load(d, rows + c.row_x), origin_x));
    y[corner] = hn::NegMulAdd(shear_y, z[corner], hn::Sub(hn::Load(d, rows + c.row_y), origin_y));
  }
  const auto edge = [](const Lanes& ax, const Lanes& ay, const Lanes& bx, const Lanes& by) {
    return hn::MulSub(ax, by, hn::Mul(ay, bx));
  };
  const auto e0 = edge(x[2], y[2], x[1], y[1]);
  const auto e1 = edge(x[0], y[0], x[2], y[2]);
  const auto e2 = edge(x[1], y[1], x[0], y[0]);
  const auto low = hn::Min(hn::Min(e0, e1), e2);
  const auto high = hn::Max(hn::Max(e0, e1), e2);
  const auto positive = hn::Set(d, bound), negative = hn::Set(d, -bound);
  // Outside where one edge function is certainly negative and another certainly positive.
  const uint32_t filled = (2u << (info.count - 1)) - 1;
  const auto outside = hn::And(hn::Lt(low, negative), hn::Gt(high, positive));
  const uint32_t crossed = ~bits_of(outside) & filled;
  if (HWY_LIKELY(crossed == 0)) return {0, 0};
  // What is hit lies at distance T / determinant along the largest component.
  const auto determinant = hn::Add(hn::Add(e0, e1), e2);
  const auto size = hn::Abs(determinant);
  const auto numerator =
      hn::Mul(hn::CopySignToAbs(hn::Set(d, 1.0f), hn::Xor(determinant, hn::Set(d, c.toward))),
              hn::MulAdd(e2, z[2], hn::MulAdd(e1, z[1], hn::Mul(e0, z[0]))));
  const auto error =
      hn::MulAdd(size, hn::Set(d, 5 * u * distance), hn::Set(d, 6.5f * bound * distance + FLT_MIN));
  const auto least = hn::Sub(numerator, error);
  const auto most = hn::Add(numerator, error);
  const float limit = t_far * c.largest_component;
  const float size_error = 3.25f * bound;
  const auto beyond =
      hn::Or(hn::Gt(least, hn::Mul(hn::Set(d, limit), hn::Add(size, hn::Set(d, size_error)))),
             hn::Lt(most, hn::Zero(d)));
  const uint32_t possible = crossed & ~bits_of(beyond);
  if constexpr (query == Query::closest_hit) return {possible, 0};
  if (possible == 0) return {0, 0};
  const auto inside = hn::Or(hn::Gt(low, positive), hn::Lt(high, negative));
  const float start = (c.t_min * (1 + 8 * u) + FLT_MIN) * c.largest_component * (1 + 8 * u);
  const auto within = hn::And(
      hn::Gt(least, hn::Mul(hn::Set(d, start), hn::Add(size, hn::Set(d, size_error)))),
      hn::Lt(most,
             hn::Mul(hn::Set(d, limit * (1 - 32 * u)), hn::Sub(size, hn::Set(d, size_error)))));
  return {possible, possible & bits_of(hn::And(inside, within))};
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

template <Query query, Slabs slabs, class Probe>
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
  float t_far = round_up(ray.t_max) * (1 + 8 * u);
  for (;;) {
    while (!current.child.is_leaf()) {
      probe.node();
      const float* node = nodes + current.child.index() * (WideTree::rows_a_node * width);
      top = push_children<slabs, query == Query::closest_hit>(tree, node, constants, t_far, top);
      if (top == stack) return;
      current = *--top;
    }
    const float entry = std::bit_cast<float>(current.entry);
    if (entry <= t_far) {
      const size_t first_block = current.child.index();
      for (size_t block = first_block;; ++block) {
        if ((block - first_block) % blocks_a_look == blocks_a_look - 1 && stop.requested()) return;
        const WideTree::BlockInfo& info = infos[block];
        probe.block(info);
        const float* rows = blocks + block * (WideTree::rows_a_block * width);
        const BlockHits hits = hit_triangles<query, slabs>(rows, info, constants, entry, t_far);
        if constexpr (query == Query::occluded) {
          if (hits.certain != 0) {
            best.primitive = 0;
            return;
          }
        }
        for (uint32_t bits = hits.possible; bits != 0; bits &= bits - 1) {
          probe.exact_test();
          const float* v = rows + std::countr_zero(bits);
          const auto vertex = [&](size_t row) {
            return Vec3f(v[row * width], v[(row + 1) * width], v[(row + 2) * width]);
          };
          const auto found = intersect_triangle(ray, vertex(0), vertex(3), vertex(6));
          if (!found) continue;
          const Hit hit{found->t, found->u, found->v, std::bit_cast<uint32_t>(v[9 * width])};
          if constexpr (query == Query::occluded) {
            best = hit;
            return;
          }
          if (hit.is_closer_than(best)) {
            best = hit;
            t_far = std::min(t_far, round_up(hit.t) * (1 + 8 * u));
          }
        }
        if (info.is_last) break;
      }
    }
    do {
      if (top == stack) return;
      current = *--top;
    } while (std::bit_cast<float>(current.entry) > t_far);
  }
}

/// False for a ray out of the filter's range.
template <Query query, class Probe>
HWY_INLINE bool answer(const WideTree& tree, const Ray& ray, const StopFlag& stop, Probe probe,
                       Hit& hit) {
  RayConstants constants;
  if (HWY_UNLIKELY(!prepare(tree, ray, constants))) return false;
  if (HWY_LIKELY(!constants.is_far_reaching)) {
    traverse<query, Slabs::fused>(tree, ray, constants, stop, probe, hit);
  } else {
    traverse<query, Slabs::exact>(tree, ray, constants, stop, probe, hit);
  }
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
