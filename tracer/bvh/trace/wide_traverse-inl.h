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
  float inverse[3];
  float near_offset[3];  // near plane * inverse + near_offset <= true distance, up to 3u relative
  float far_offset[3];
  size_t near_row[3];  // of a node: 2 * axis, or 2 * axis + 1 for a negative direction
  int kx, ky, kz;      // kz: the direction's largest component
  float shear_x, shear_y;
  float origin[3];
  float largest_component;  // |direction[kz]|
  float slack;              // how far outside its box the padded slabs let a ray pass, at most
  float t_min;              // rounded down
};

HWY_INLINE float round_up(double value) {
  const float rounded = static_cast<float>(value);
  return static_cast<double>(rounded) < value ? std::nextafterf(rounded, FLT_MAX * 2) : rounded;
}

HWY_INLINE RayConstants prepare(const WideTree& tree, const Ray& ray) {
  RayConstants c;
  const Vec3f& d = ray.direction;
  const float size[3] = {std::abs(d.x), std::abs(d.y), std::abs(d.z)};
  c.kz = size[0] >= size[1] ? (size[0] >= size[2] ? 0 : 2) : (size[1] >= size[2] ? 1 : 2);
  c.kx = c.kz == 2 ? 0 : c.kz + 1;
  c.ky = c.kx == 2 ? 0 : c.kx + 1;
  c.shear_x = d[c.kx] / d[c.kz];
  c.shear_y = d[c.ky] / d[c.kz];
  c.largest_component = size[c.kz];
  float reach = 0;  // of all coordinates that meet in a slab test
  for (int axis = 0; axis < 3; ++axis) {
    c.origin[axis] = ray.origin[axis];
    reach = std::max(reach, std::abs(ray.origin[axis]));
  }
  reach += tree.max_coordinate;
  c.slack = 32 * u * reach;
  // A component so small that it moves the ray by less than the slack within the scene counts as
  // this small, and its slab is widened to last for all distances that matter.
  const float smallest = 0x1p-40f * c.largest_component;
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_parallel = size[axis] < smallest;
    const float component = std::copysign(is_parallel ? smallest : size[axis], d[axis]);
    c.inverse[axis] = 1.0f / component;
    c.near_row[axis] = 2 * static_cast<size_t>(axis) + (std::signbit(d[axis]) ? 1 : 0);
    const float offset = -(ray.origin[axis] * c.inverse[axis]);
    const float pad = (is_parallel ? 16 : 8) * u * reach * std::abs(c.inverse[axis]);
    c.near_offset[axis] = offset - pad;
    c.far_offset[axis] = offset + pad;
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

/// Bits of the children whose boxes the ray may meet before t_max; their entries in `entry`.
HWY_INLINE uint32_t hit_children(const float* node, const RayConstants& c, float t_max,
                                 float* HWY_RESTRICT entry) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  const auto plane = [&](size_t row, int axis, float offset) {
    return hn::MulAdd(hn::Load(d, node + row * width), hn::Set(d, c.inverse[axis]),
                      hn::Set(d, offset));
  };
  const auto near_x = plane(c.near_row[0], 0, c.near_offset[0]);
  const auto near_y = plane(c.near_row[1], 1, c.near_offset[1]);
  const auto near_z = plane(c.near_row[2], 2, c.near_offset[2]);
  const auto far_x = plane(c.near_row[0] ^ 1, 0, c.far_offset[0]);
  const auto far_y = plane(c.near_row[1] ^ 1, 1, c.far_offset[1]);
  const auto far_z = plane(c.near_row[2] ^ 1, 2, c.far_offset[2]);
  const auto near = hn::Max(hn::Max(near_x, near_y), hn::Max(near_z, hn::Set(d, c.t_min)));
  const auto far = hn::Min(hn::Min(far_x, far_y), hn::Min(far_z, hn::Set(d, t_max)));
  const auto mask = hn::Le(near, hn::Mul(far, hn::Set(d, 1 + 8 * u)));
  hn::Store(near, d, entry);
  return bits_of(mask);
}

/// Bits of the triangles of a block that the ray may hit: the sheared edge functions [Woop 2013]
/// of the float-rounded vertices, with `bound` at least their error.
HWY_INLINE uint32_t hit_triangles(const float* block, const WideTree::BlockInfo& info,
                                  const RayConstants& c, float entry, float t_max) {
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

  const auto origin_x = hn::Set(d, c.origin[c.kx]);
  const auto origin_y = hn::Set(d, c.origin[c.ky]);
  const auto origin_z = hn::Set(d, c.origin[c.kz]);
  const auto shear_x = hn::Set(d, c.shear_x);
  const auto shear_y = hn::Set(d, c.shear_y);
  Lanes x[3], y[3], z[3];
  for (int corner = 0; corner < 3; ++corner) {
    const float* rows = block + 3 * static_cast<size_t>(corner) * width;
    z[corner] = hn::Sub(hn::Load(d, rows + static_cast<size_t>(c.kz) * width), origin_z);
    x[corner] =
        hn::NegMulAdd(shear_x, z[corner],
                      hn::Sub(hn::Load(d, rows + static_cast<size_t>(c.kx) * width), origin_x));
    y[corner] =
        hn::NegMulAdd(shear_y, z[corner],
                      hn::Sub(hn::Load(d, rows + static_cast<size_t>(c.ky) * width), origin_y));
  }
  const auto edge = [](const Lanes& ax, const Lanes& ay, const Lanes& bx, const Lanes& by) {
    return hn::MulSub(ax, by, hn::Mul(ay, bx));
  };
  const auto e0 = edge(x[2], y[2], x[1], y[1]);
  const auto e1 = edge(x[0], y[0], x[2], y[2]);
  const auto e2 = edge(x[1], y[1], x[0], y[0]);
  const auto low = hn::Min(hn::Min(e0, e1), e2);
  const auto high = hn::Max(hn::Max(e0, e1), e2);
  // Outside where one edge function is certainly negative and another certainly positive.
  auto outside = hn::And(hn::Lt(low, hn::Set(d, -bound)), hn::Gt(high, hn::Set(d, bound)));
  if (HWY_LIKELY(hn::AllTrue(d, outside))) return 0;
  // A hit lies between the nearest and the farthest vertex along the largest component.
  const float sign = std::signbit(c.inverse[c.kz]) ? -1.0f : 1.0f;
  const auto toward = hn::Set(d, sign);
  const auto z0 = hn::Mul(z[0], toward), z1 = hn::Mul(z[1], toward), z2 = hn::Mul(z[2], toward);
  const auto nearest = hn::Min(hn::Min(z0, z1), z2);
  const auto farthest = hn::Max(hn::Max(z0, z1), z2);
  const float limit = t_max * c.largest_component * (1 + 8 * u);
  outside = hn::Or(outside, hn::Or(hn::Gt(nearest, hn::Set(d, limit + vertex_error)),
                                   hn::Lt(farthest, hn::Set(d, -vertex_error))));
  return ~bits_of(outside) & ((2u << (info.count - 1)) - 1);
}

struct StackEntry {
  WideChild child;
  float entry;
};

/// Pushes the children so that the nearest is popped first.
HWY_INLINE StackEntry* push_children(const float* node, uint32_t bits, const float* entry,
                                     bool is_sorted, StackEntry* top) {
  const Floats d;
  const float* children = node + 6 * hn::Lanes(d);
  StackEntry* const base = top;
  while (bits != 0) {
    const int lane = std::countr_zero(bits);
    bits &= bits - 1;
    const StackEntry pushed{{std::bit_cast<uint32_t>(children[lane])}, entry[lane]};
    StackEntry* at = top++;
    if (is_sorted) {
      for (; at > base && at[-1].entry < pushed.entry; --at) *at = at[-1];
    }
    *at = pushed;
  }
  return top;
}

template <Query query>
HWY_INLINE Hit traverse(const WideTree& tree, const Ray& ray, const StopFlag& stop) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  const RayConstants constants = prepare(tree, ray);
  alignas(64) float entry[hn::MaxLanes(Floats())];
  StackEntry stack[stack_capacity];
  StackEntry* top = stack;
  *top++ = {WideChild::node(0), constants.t_min};
  Hit best;
  float t_max = round_up(ray.t_max);
  while (top != stack) {
    const StackEntry popped = *--top;
    if (popped.entry > t_max * (1 + 8 * u)) continue;
    if (!popped.child.is_leaf()) {
      const float* node = tree.nodes.row(popped.child.index() * WideTree::rows_a_node);
      const uint32_t bits = hit_children(node, constants, t_max, entry);
      top = push_children(node, bits, entry, query == Query::closest_hit, top);
      continue;
    }
    const size_t first_block = popped.child.index();
    for (size_t block = first_block;; ++block) {
      if ((block - first_block) % blocks_a_look == blocks_a_look - 1 && stop.requested()) return {};
      const WideTree::BlockInfo& info = tree.block_infos[block];
      const float* rows = tree.blocks.row(block * WideTree::rows_a_block);
      uint32_t bits = hit_triangles(rows, info, constants, popped.entry, t_max);
      while (bits != 0) {
        const int lane = std::countr_zero(bits);
        bits &= bits - 1;
        const float* v = rows + lane;
        const auto vertex = [&](size_t row) {
          return Vec3f(v[row * width], v[(row + 1) * width], v[(row + 2) * width]);
        };
        const auto found = intersect_triangle(ray, vertex(0), vertex(3), vertex(6));
        if (!found) continue;
        const Hit hit{found->t, found->u, found->v, std::bit_cast<uint32_t>(v[9 * width])};
        if constexpr (query == Query::occluded) return hit;
        if (hit.is_closer_than(best)) {
          best = hit;
          t_max = std::min(t_max, round_up(hit.t));
        }
      }
      if (info.is_last) break;
    }
  }
  return best;
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
