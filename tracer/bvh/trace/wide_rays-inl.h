// SPDX-License-Identifier: MIT
// What a node's slab tests and a block's filter need of a ray, and the slab tests, compiled once
// for each instruction set. docs/numerics.md derives the bounds.
#if defined(TRACER_WIDE_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_WIDE_RAYS_INL_H
#undef TRACER_WIDE_RAYS_INL_H
#else
#define TRACER_WIDE_RAYS_INL_H
#endif

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>

#include <hwy/highway.h>

#include "tracer/bvh/layout/wide_tree.h"
#include "tracer/geometry/ray.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

using Floats = hn::CappedTag<float, 16>;
using Lanes = hn::Vec<Floats>;

constexpr float u = 0x1p-24f;  // half an ulp of 1
// Between them no product of the filter over or underflows.
constexpr float least_coordinate = 0x1p-36f;
constexpr float greatest_coordinate = 0x1p36f;

/// How the distance of a plane is computed. With one instruction, and an error relative to all
/// coordinates of the scene; or with two, and an error relative to that distance: for rays in
/// scenes much larger than their leaves. Or with two of a moved origin, whose error is added.
enum class Slabs { fused, exact, moved };

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
  // As the leaf's filter takes them: z is the axis of the direction's largest component.
  alignas(16) float leaf_origin[4];
  alignas(16) float shear[4];        // x, y
  alignas(16) uint32_t leaf_row[4];  // of a vertex in a block, in floats
  float toward;                      // sign of the largest component
  float largest_component;           // its size
  bool is_far_reaching;              // Slabs::exact pays
  float slack;         // how far outside its box the padded slabs let a ray pass, at most
  float t_min;         // rounded down, less t_offset
  float origin_error;  // of each coordinate, where the origin was moved
  double t_offset;     // distances of the filter are less by this
};

/// Lanes of the axes x, y, z of the leaf's filter, by the axis of its z.
alignas(16) constexpr uint32_t leaf_axes[3][4] = {{1, 2, 0, 3}, {2, 0, 1, 3}, {0, 1, 2, 3}};

HWY_INLINE float largest_component(const Vec3f& v) {
  return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
}

/// Where to stop in the filter for hits up to `t`: at least t (1 + 8u), and never before the start.
HWY_INLINE float stop_at(const RayConstants& c, double t) {
  return static_cast<float>(std::max(t - c.t_offset, 0.0)) * (1 + 12 * u) + FLT_MIN;
}

enum class Query { closest_hit, occluded };

/// Where hits count.
struct HitRange {
  float t_far;  // as stop_at() gives it
  // Query::occluded: hits before it certainly count, where those near the start do: a distance
  // times the largest component, or less than 0.
  float certain_end;
};

template <Query query>
HWY_INLINE HitRange hit_range(const RayConstants& c, const Ray& ray) {
  const float t_far = stop_at(c, ray.t_max);
  if constexpr (query == Query::closest_hit) return {t_far, -1};
  const float end = (t_far * (1 - 32 * u) - 2 * FLT_MIN) * c.largest_component;
  return {t_far, ray.t_min <= 0 ? end : -1};
}

/// Rays from far away start for the filter where they come to the scene: its bounds grow with the
/// distance. Returns the origin there.
HWY_NOINLINE inline Vec3f move_origin(const WideTree& tree, const Ray& ray, RayConstants& c) {
  const double size = tree.max_coordinate;
  const Vec3d origin(ray.origin), direction(ray.direction);
  const double outside = max_abs(origin);
  double t = 0;
  const auto meet_slab = [&](double from, double speed) {
    if (speed != 0) t = std::max(t, (-std::copysign(size, speed) - from) / speed);
  };
  meet_slab(origin.x, direction.x);
  meet_slab(origin.y, direction.y);
  meet_slab(origin.z, direction.z);
  t *= 1 - 0x1p-30;  // so that nothing lies behind, by any rounding
  const Vec3d moved = origin + t * direction;
  const double farthest = max_abs(moved);
  // Not ">": NaN stays. Farther away, doubles round too; and what passes by is not worth it.
  if (!(outside < 0x1p20 * size && farthest < 4 * size)) return ray.origin;
  c.t_offset = t * (1 - 0x1p-31);
  c.origin_error = static_cast<float>(1.01 * (u * farthest + 0x1p-50 * outside)) + FLT_MIN;
  return Vec3f(moved);
}

struct SlabsThatPay {
  static constexpr bool may_move = true;
  Slabs operator()(const RayConstants& c) const {
    if (c.origin_error > 0) return Slabs::moved;
    return c.is_far_reaching ? Slabs::exact : Slabs::fused;
  }
};

/// All are right for any ray.
template <Slabs slabs>
struct TheseSlabs {
  static constexpr bool may_move = slabs == Slabs::moved;
  Slabs operator()(const RayConstants&) const { return slabs; }
};

/// Whether the ray is in the filter's range.
template <class ChooseSlabs = SlabsThatPay>
HWY_INLINE bool prepare(const WideTree& tree, const Ray& ray, RayConstants& c,
                        ChooseSlabs choose_slabs = {}) {
  const auto width = static_cast<uint32_t>(hn::Lanes(Floats()));
  const hn::FixedTag<float, 4> d4;
  const hn::RebindToUnsigned<decltype(d4)> du4;
  Vec3f o = ray.origin;
  const Vec3f& direction = ray.direction;
  c.t_offset = 0;
  c.origin_error = 0;
  if constexpr (ChooseSlabs::may_move) {
    if (HWY_UNLIKELY(largest_component(o) > 8 * tree.max_coordinate)) {
      o = move_origin(tree, ray, c);
    }
  }
  // In registers: a load of what was stored in smaller parts would wait for the stores.
  const auto lanes = [&](const Vec3f& v, float unused) {
    return hn::ConcatLowerLower(d4, hn::InterleaveLower(d4, hn::Set(d4, v.z), hn::Set(d4, unused)),
                                hn::InterleaveLower(d4, hn::Set(d4, v.x), hn::Set(d4, v.y)));
  };
  const auto origin = lanes(o, 0);
  const auto component = lanes(direction, greatest_coordinate);
  const auto size = hn::Abs(component);

  // Of all coordinates that meet in a slab test.
  const float reach = largest_component(o) + tree.max_coordinate;
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
  if (HWY_LIKELY(choose_slabs(c) == Slabs::fused)) {
    const auto offset = hn::Neg(hn::Mul(origin, inverse));
    const auto pad = hn::IfThenElse(is_parallel, wide_pad, hn::Mul(wide_pad, hn::Set(d4, 0.5f)));
    hn::Store(hn::Sub(offset, pad), d4, c.near_offset);
    hn::Store(hn::Add(offset, pad), d4, c.far_offset);
  } else {
    // What underflows rounds absolutely.
    const auto least_pad =
        hn::MulAdd(hn::Abs(inverse), hn::Set(d4, 1.5f * c.origin_error), hn::Set(d4, FLT_MIN));
    if (!has_parallel && c.origin_error == 0) c.slack = 0;
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
  const auto is_z = static_cast<uint32_t>(size_z > size_xy);
  const auto is_y = static_cast<uint32_t>(size_y > size_x);
  const auto axes = hn::Load(du4, leaf_axes[2 * is_z + (is_y & ~is_z)]);
  const auto order = hn::IndicesFromVec(d4, axes);
  const auto leaf_component = hn::TableLookupLanes(component, order);
  const auto leaf_inverse = hn::TableLookupLanes(inverse, order);
  hn::Store(hn::TableLookupLanes(origin, order), d4, c.leaf_origin);
  hn::Store(hn::Mul(leaf_component, hn::Broadcast<2>(leaf_inverse)), d4, c.shear);
  hn::Store(hn::Mul(axes, hn::Set(du4, width)), du4, c.leaf_row);
  c.toward = hn::ExtractLane(hn::CopySign(hn::Set(d4, 1.0f), leaf_component), 2);
  const auto t_min = static_cast<float>(ray.t_min - c.t_offset * (1 + 0x1p-30));
  c.t_min = std::max(0.0f, t_min - std::abs(t_min) * 2 * u);
  return true;
}

/// f<slabs>() with the slabs that pay for the ray.
template <class F>
HWY_INLINE auto with_slabs(const RayConstants& c, const F& f) {
  switch (SlabsThatPay()(c)) {
    case Slabs::exact:
      return f.template operator()<Slabs::exact>();
    case Slabs::moved:
      return f.template operator()<Slabs::moved>();
    default:
      return f.template operator()<Slabs::fused>();
  }
}

/// Lane i of the mask as bit i. Loads what was stored, no more, so that the store is forwarded.
template <class D>
HWY_INLINE uint32_t bits_of(D d, const hn::Mask<D>& mask) {
  uint8_t bytes[8];
  hn::StoreMaskBits(d, mask, bytes);
  if constexpr (hn::MaxLanes(d) <= 8) return bytes[0];
  uint16_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

HWY_INLINE uint32_t bits_of(const hn::Mask<Floats>& mask) {
  return bits_of(Floats(), mask);
}

/// Which children's boxes the ray may meet before t_far, and where it enters them.
struct SlabHits {
  Lanes entry;
  hn::Mask<Floats> is_hit;
};

/// t_far: as stop_at gives it.
template <Slabs slabs>
HWY_INLINE SlabHits hit_slabs(const float* HWY_RESTRICT node, const RayConstants& c, float t_far) {
  const Floats d;
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
  return {near, hn::Le(near, widest)};
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
