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

#include <hwy/highway.h>

#include "tracer/bvh/build_settings.h"
#include "tracer/bvh/trace/wide_kernels.h"
#include "tracer/geometry/triangle.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

enum class Query { closest_hit, occluded };

using Floats = hn::CappedTag<float, 16>;
using Lanes = hn::Vec<Floats>;

constexpr float u = 0x1p-24f;  // half an ulp of 1
constexpr int stack_capacity = max_tree_depth * 16;
// Of one leaf, between two looks at the stop flag: some 10 microseconds.
constexpr size_t blocks_a_look = 256;

/// What of a ray the slab tests and the triangle filter need, computed once.
struct RayConstants {
  float near_inverse[3];
  float near_offset[3];  // near plane * near_inverse + near_offset <= true distance * (1 + 3u)
  float far_inverse[3];
  float far_offset[3];  // far plane * far_inverse + far_offset >= true distance * (1 + 4u)
  size_t near_row[3];   // of a node, in floats: min, or max for a negative direction
  size_t far_row[3];
  size_t row_x, row_y, row_z;  // of a vertex in a block; z: the direction's largest component
  float origin_x, origin_y, origin_z;
  float shear_x, shear_y;
  float toward;             // sign of the largest component
  float largest_component;  // its size
  float slack;              // how far outside its box the padded slabs let a ray pass, at most
  float t_min;              // rounded down
};

HWY_INLINE float round_up(double value) {
  const float rounded = static_cast<float>(value);
  return static_cast<double>(rounded) < value ? std::nextafterf(rounded, FLT_MAX * 2) : rounded;
}

HWY_INLINE RayConstants prepare(const WideTree& tree, const Ray& ray) {
  RayConstants c;
  const size_t width = hn::Lanes(Floats());
  const Vec3f& d = ray.direction;
  const float size[3] = {std::abs(d.x), std::abs(d.y), std::abs(d.z)};
  const int z = size[0] >= size[1] ? (size[0] >= size[2] ? 0 : 2) : (size[1] >= size[2] ? 1 : 2);
  const int x = z == 2 ? 0 : z + 1;
  const int y = x == 2 ? 0 : x + 1;
  c.row_x = static_cast<size_t>(x) * width;
  c.row_y = static_cast<size_t>(y) * width;
  c.row_z = static_cast<size_t>(z) * width;
  c.origin_x = ray.origin[x];
  c.origin_y = ray.origin[y];
  c.origin_z = ray.origin[z];
  c.shear_x = d[x] / d[z];
  c.shear_y = d[y] / d[z];
  c.toward = std::signbit(d[z]) ? -1.0f : 1.0f;
  c.largest_component = size[z];
  // Of all coordinates that meet in a slab test.
  const float reach =
      std::max({std::abs(ray.origin.x), std::abs(ray.origin.y), std::abs(ray.origin.z)}) +
      tree.max_coordinate;
  c.slack = 32 * u * reach;
  // A component so small that it moves the ray by less than the slack within the scene counts as
  // this small, and its slab is widened to last for all distances that matter.
  const float smallest = 0x1p-40f * c.largest_component;
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_parallel = size[axis] < smallest;
    const float component = std::copysign(is_parallel ? smallest : size[axis], d[axis]);
    const float inverse = 1.0f / component;
    const size_t is_negative = std::signbit(d[axis]) ? 1 : 0;
    c.near_row[axis] = (2 * static_cast<size_t>(axis) + is_negative) * width;
    c.far_row[axis] = (2 * static_cast<size_t>(axis) + 1 - is_negative) * width;
    const float offset = -(ray.origin[axis] * inverse);
    const float pad = (is_parallel ? 16 : 8) * u * reach * std::abs(inverse);
    c.near_inverse[axis] = inverse;
    c.near_offset[axis] = offset - pad;
    c.far_inverse[axis] = inverse * (1 + 8 * u);
    c.far_offset[axis] = (offset + pad) * (1 + 8 * u);
  }
  const auto t_min = static_cast<float>(ray.t_min);
  c.t_min = std::max(0.0f, t_min - std::abs(t_min) * 2 * u);
  return c;
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

/// Pushes the children whose boxes the ray may meet before t_far, so that the nearest is popped
/// first if `is_sorted`. t_far: the distance to stop at, times 1 + 8u.
template <bool is_sorted>
HWY_INLINE StackEntry* push_children(const float* HWY_RESTRICT node, const RayConstants& c,
                                     float t_far, StackEntry* HWY_RESTRICT top) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  const auto near_plane = [&](int axis) {
    return hn::MulAdd(hn::Load(d, node + c.near_row[axis]), hn::Set(d, c.near_inverse[axis]),
                      hn::Set(d, c.near_offset[axis]));
  };
  const auto far_plane = [&](int axis) {
    return hn::MulAdd(hn::Load(d, node + c.far_row[axis]), hn::Set(d, c.far_inverse[axis]),
                      hn::Set(d, c.far_offset[axis]));
  };
  const auto near =
      hn::Max(hn::Max(near_plane(0), near_plane(1)), hn::Max(near_plane(2), hn::Set(d, c.t_min)));
  const auto far =
      hn::Min(hn::Min(far_plane(0), far_plane(1)), hn::Min(far_plane(2), hn::Set(d, t_far)));
  uint32_t bits = bits_of(hn::Le(near, far));
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
template <Query query>
HWY_INLINE BlockHits hit_triangles(const float* HWY_RESTRICT block, const WideTree::BlockInfo& info,
                                   const RayConstants& c, float entry, float t_far) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  // Both hold for every vertex of a leaf whose padded box the ray meets at `entry`.
  const float extent = info.extent + c.slack;
  const float distance = entry * c.largest_component + extent;
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

template <Query query>
HWY_INLINE Hit traverse(const WideTree& tree, const Ray& ray, const StopFlag& stop) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  const RayConstants constants = prepare(tree, ray);
  const float* const nodes = tree.nodes.row(0);
  const float* const blocks = tree.blocks.row(0);
  StackEntry stack[stack_capacity];
  StackEntry* top = stack;
  StackEntry current{WideChild::node(0), std::bit_cast<uint32_t>(constants.t_min)};
  Hit best;
  float t_far = round_up(ray.t_max) * (1 + 8 * u);
  for (;;) {
    while (!current.child.is_leaf()) {
      const float* node = nodes + current.child.index() * (WideTree::rows_a_node * width);
      top = push_children<query == Query::closest_hit>(node, constants, t_far, top);
      if (top == stack) return best;
      current = *--top;
    }
    const float entry = std::bit_cast<float>(current.entry);
    if (entry <= t_far) {
      const size_t first_block = current.child.index();
      for (size_t block = first_block;; ++block) {
        if ((block - first_block) % blocks_a_look == blocks_a_look - 1 && stop.requested())
          return {};
        const WideTree::BlockInfo& info = tree.block_infos[block];
        const float* rows = blocks + block * (WideTree::rows_a_block * width);
        const BlockHits hits = hit_triangles<query>(rows, info, constants, entry, t_far);
        if constexpr (query == Query::occluded) {
          if (hits.certain != 0) return {.t = 0, .primitive = 0};
        }
        for (uint32_t bits = hits.possible; bits != 0; bits &= bits - 1) {
          const float* v = rows + std::countr_zero(bits);
          const auto vertex = [&](size_t row) {
            return Vec3f(v[row * width], v[(row + 1) * width], v[(row + 2) * width]);
          };
          const auto found = intersect_triangle(ray, vertex(0), vertex(3), vertex(6));
          if (!found) continue;
          const Hit hit{found->t, found->u, found->v, std::bit_cast<uint32_t>(v[9 * width])};
          if constexpr (query == Query::occluded) return hit;
          if (hit.is_closer_than(best)) {
            best = hit;
            t_far = std::min(t_far, round_up(hit.t) * (1 + 8 * u));
          }
        }
        if (info.is_last) break;
      }
    }
    do {
      if (top == stack) return best;
      current = *--top;
    } while (std::bit_cast<float>(current.entry) > t_far);
  }
}

// NOLINTBEGIN(misc-definitions-in-headers): each instruction set has a namespace of its own.
int KernelWidth() {
#if HWY_TARGET == HWY_SCALAR
  return 0;
#else
  return static_cast<int>(hn::Lanes(Floats()));
#endif
}

Hit ClosestHit(const WideTree& tree, const Ray& ray, const StopFlag& stop) {
  return traverse<Query::closest_hit>(tree, ray, stop);
}

bool Occluded(const WideTree& tree, const Ray& ray, const StopFlag& stop) {
  return traverse<Query::occluded>(tree, ray, stop).is_hit();
}
// NOLINTEND(misc-definitions-in-headers)

}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
