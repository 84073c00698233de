// SPDX-License-Identifier: MIT
// A bundle against the triangles of a block: planes through the common point and each edge, shared
// by all rays. docs/numerics.md derives the bounds.
#if defined(TRACER_BUNDLE_LEAF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_BUNDLE_LEAF_INL_H
#undef TRACER_BUNDLE_LEAF_INL_H
#else
#define TRACER_BUNDLE_LEAF_INL_H
#endif

#include <hwy/highway.h>

#include "tracer/bvh/trace/bundle_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR

/// Of the triangles of a block, one a lane.
struct BlockPlanes {
  struct Row {
    alignas(64) float lane[hn::MaxLanes(Floats())];
  };

  Row edge[3][3];      // normals of the planes through the point and an edge; inside >= 0
  Row normal[3];       // of the triangle, their exact sum
  Row vertex[3];       // v0, seen from the point
  Row edge_error;      // of a ray's edge function
  Row normal_floor;    // determinants above it are known to a quarter
  Row depth_error;     // times the inverse determinant: of a depth relative to v0's
  Row vertex_error;    // of v0's depth
  Row nearest;         // least depth of a vertex
  uint32_t vague = 0;  // lanes whose plane may hold the point: which side is inside is not known
};

HWY_INLINE void find_planes(const float* HWY_RESTRICT rows, const Bundle& bundle,
                            BlockPlanes& planes) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  struct Vectors {
    Lanes x, y, z;
  };
  const auto minus = [](const Vectors& a, const Vectors& b) {
    return Vectors{hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
  };
  const auto cross = [](const Vectors& a, const Vectors& b) {
    return Vectors{hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
                   hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
  };
  const auto largest = [](const Vectors& v) {
    return hn::Max(hn::Max(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
  };
  const auto toward = hn::Set(d, bundle.toward);
  const auto corner = [&](size_t index) {
    const float* first = rows + 3 * index * width;
    return Vectors{hn::Load(d, first + bundle.axis_x * width),
                   hn::Load(d, first + bundle.axis_y * width),
                   hn::Mul(hn::Load(d, first + bundle.axis_z * width), toward)};
  };
  const auto component = [&](size_t axis) { return bundle.point[static_cast<int>(axis)]; };
  const Vectors point{hn::Set(d, component(bundle.axis_x)), hn::Set(d, component(bundle.axis_y)),
                      hn::Set(d, component(bundle.axis_z) * bundle.toward)};
  const Vectors v0 = corner(0), v1 = corner(1), v2 = corner(2);
  const Vectors a = minus(v0, point), b = minus(v1, point), c = minus(v2, point);
  const Vectors edge1 = minus(v1, v0), edge2 = minus(v0, v2), edge0 = minus(v2, v1);
  const Vectors normal = cross(edge1, edge2);
  const auto volume = hn::MulAdd(a.x, normal.x, hn::MulAdd(a.y, normal.y, hn::Mul(a.z, normal.z)));

  const auto length = hn::Max(hn::Max(largest(edge0), largest(edge1)), largest(edge2));
  // Of any vertex, and what the rays' passing beside the point adds to every error.
  const auto distance = hn::Add(hn::Add(largest(a), length), hn::Set(d, bundle.deviation / u));
  const float slopes = 1 + 2 * greatest_slope;
  const auto tiny = hn::Set(d, FLT_MIN);
  const auto area = hn::Mul(length, length);
  const auto volume_error =
      hn::MulAdd(hn::Mul(area, distance), hn::Set(d, 72 * u), hn::Set(d, FLT_MIN));
  const auto normal_error = hn::MulAdd(area, hn::Set(d, 20 * slopes * u), tiny);
  planes.vague = ~bits_of(hn::Gt(hn::Abs(volume), volume_error));
  const auto side = hn::And(volume, hn::SignBit(d));
  const auto keep = [&](const Vectors& v, BlockPlanes::Row* row) {
    hn::Store(hn::Xor(v.x, side), d, row[0].lane);
    hn::Store(hn::Xor(v.y, side), d, row[1].lane);
    hn::Store(hn::Xor(v.z, side), d, row[2].lane);
  };
  keep(cross(edge0, b), planes.edge[0]);
  keep(cross(edge2, c), planes.edge[1]);
  keep(cross(edge1, a), planes.edge[2]);
  keep(normal, planes.normal);
  hn::Store(a.x, d, planes.vertex[0].lane);
  hn::Store(a.y, d, planes.vertex[1].lane);
  hn::Store(a.z, d, planes.vertex[2].lane);
  hn::Store(hn::MulAdd(hn::Mul(length, distance), hn::Set(d, 20 * slopes * u), tiny), d,
            planes.edge_error.lane);
  hn::Store(hn::Mul(normal_error, hn::Set(d, 4.0f)), d, planes.normal_floor.lane);
  hn::Store(hn::MulAdd(hn::MulAdd(length, hn::Set(d, 130 + 28 * slopes),
                                  hn::Mul(distance, hn::Set(d, 9 * slopes))),
                       hn::Mul(area, hn::Set(d, u)), tiny),
            d, planes.depth_error.lane);
  hn::Store(hn::MulAdd(distance, hn::Set(d, 8 * u), tiny), d, planes.vertex_error.lane);
  hn::Store(hn::Min(hn::Min(a.z, b.z), c.z), d, planes.nearest.lane);
}

/// Lanes that a ray of the group may hit at a depth that counts.
HWY_INLINE uint32_t cull(const BlockPlanes& planes, const Bundle& bundle, size_t group) {
  const Floats d;
  const auto low_x = hn::Set(d, bundle.low_x[group]), high_x = hn::Set(d, bundle.high_x[group]);
  const auto low_y = hn::Set(d, bundle.low_y[group]), high_y = hn::Set(d, bundle.high_y[group]);
  const auto greatest = [&](const BlockPlanes::Row* plane) {
    const auto x = hn::Load(d, plane[0].lane), y = hn::Load(d, plane[1].lane);
    return hn::Add(hn::Load(d, plane[2].lane),
                   hn::Add(hn::Max(hn::Mul(x, low_x), hn::Mul(x, high_x)),
                           hn::Max(hn::Mul(y, low_y), hn::Mul(y, high_y))));
  };
  const auto inside = hn::Min(hn::Min(greatest(planes.edge[0]), greatest(planes.edge[1])),
                              greatest(planes.edge[2]));
  const auto may_cross = hn::Ge(hn::Add(inside, hn::Load(d, planes.edge_error.lane)), hn::Zero(d));
  const auto most = hn::Set(d, bundle.group_most[group] * (1 + 8 * u));
  return (bits_of(may_cross) | planes.vague) &
         bits_of(hn::Le(hn::Load(d, planes.nearest.lane), most));
}

/// Rays of a group that one triangle concerns: `possible` ones may hit it where hits count, and
/// `certain` ones of them do, at a depth in [least, most].
struct GroupHits {
  uint32_t possible;
  hn::Mask<Floats> certain;
  Lanes least, most;
};

HWY_INLINE GroupHits meet(const BlockPlanes& planes, int lane, const Bundle& bundle, size_t group) {
  const Floats d;
  const size_t first = group * hn::Lanes(d);
  const auto x = hn::Load(d, bundle.slope_x + first), y = hn::Load(d, bundle.slope_y + first);
  const auto along = [&](const BlockPlanes::Row* plane) {
    return hn::MulAdd(
        hn::Set(d, plane[0].lane[lane]), x,
        hn::MulAdd(hn::Set(d, plane[1].lane[lane]), y, hn::Set(d, plane[2].lane[lane])));
  };
  const auto edge0 = along(planes.edge[0]), edge1 = along(planes.edge[1]);
  const auto edge2 = along(planes.edge[2]);
  const auto low = hn::Min(hn::Min(edge0, edge1), edge2);
  const float error = planes.edge_error.lane[lane];
  auto outside = hn::Lt(low, hn::Set(d, -error));
  const bool is_vague = (planes.vague >> lane & 1) != 0;
  if (HWY_UNLIKELY(is_vague)) {
    const auto high = hn::Max(hn::Max(edge0, edge1), edge2);
    outside = hn::And(outside, hn::Gt(high, hn::Set(d, error)));
  }
  const auto crossed = hn::Not(outside);
  if (hn::AllFalse(d, crossed)) return {0, crossed, x, x};

  const auto determinant = along(planes.normal);
  const auto vertex_depth = hn::Set(d, planes.vertex[2].lane[lane]);
  const auto to_x = hn::NegMulAdd(x, vertex_depth, hn::Set(d, planes.vertex[0].lane[lane]));
  const auto to_y = hn::NegMulAdd(y, vertex_depth, hn::Set(d, planes.vertex[1].lane[lane]));
  const auto inverse = hn::Div(hn::Set(d, 1.0f), determinant);
  const auto moment = hn::MulAdd(hn::Set(d, planes.normal[0].lane[lane]), to_x,
                                 hn::Mul(hn::Set(d, planes.normal[1].lane[lane]), to_y));
  const auto depth = hn::MulAdd(moment, inverse, vertex_depth);
  const auto depth_error = hn::MulAdd(hn::Set(d, planes.depth_error.lane[lane]), inverse,
                                      hn::Set(d, planes.vertex_error.lane[lane]));
  const auto least = hn::Sub(depth, depth_error), most = hn::Add(depth, depth_error);
  const auto is_known = hn::Gt(determinant, hn::Set(d, planes.normal_floor.lane[lane]));
  const auto beyond = hn::And(is_known, hn::Gt(least, hn::Load(d, bundle.most + first)));
  const auto possible = hn::AndNot(beyond, crossed);
  if (HWY_UNLIKELY(is_vague)) return {bits_of(possible), hn::Lt(x, x), least, most};
  const auto counts = hn::And(hn::Gt(least, hn::Load(d, bundle.start + first)),
                              hn::Lt(most, hn::Load(d, bundle.least + first)));
  const auto inside = hn::Gt(low, hn::Set(d, error));
  return {bits_of(possible), hn::And(hn::And(inside, is_known), counts), least, most};
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
