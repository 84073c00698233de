// SPDX-License-Identifier: MIT
// Rays through one point, as bundles take them. docs/numerics.md derives the bounds.
#if defined(TRACER_BUNDLE_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_BUNDLE_RAYS_INL_H
#undef TRACER_BUNDLE_RAYS_INL_H
#else
#define TRACER_BUNDLE_RAYS_INL_H
#endif

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <limits>
#include <span>

#include <hwy/highway.h>

#include "tracer/bvh/trace/bundle_kernels.h"
#include "tracer/bvh/trace/wide_traverse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR

constexpr uint32_t no_winner = 0xffffffffu;
constexpr float nothing_counts = -std::numeric_limits<float>::infinity();
// Of a ray's direction: no component is larger than this many times the one along the depth.
constexpr float greatest_slope = 2;
// Wider bundles meet most of what is in a node, and are better traced one by one.
constexpr float greatest_spread = 0.5f;

/// Rays through one point: the origin of camera rays, the end of shadow rays. Seen from it, with
/// the axes permuted so that the last one, the depth, grows along all of them: at depth w ray i is
/// at (slope_x[i] * w, slope_y[i] * w). A group is the rays of one SIMD vector.
struct Bundle {
  static constexpr size_t max_groups = bundle_size / 4;

  alignas(64) float direction_x[bundle_size];
  alignas(64) float direction_y[bundle_size];
  alignas(64) float speed[bundle_size];  // depth per unit of t: that of the direction
  alignas(64) float slope_x[bundle_size];
  alignas(64) float slope_y[bundle_size];
  // Depths. Beyond `start` and before `least` a hit certainly counts; beyond `most` none does.
  alignas(64) float start[bundle_size];
  alignas(64) float least[bundle_size];
  alignas(64) float most[bundle_size];
  alignas(64) uint32_t winner[bundle_size];  // block * width + lane, or no_winner

  float low_x[max_groups], high_x[max_groups];  // slopes of a group
  float low_y[max_groups], high_y[max_groups];
  float group_most[max_groups];
  size_t ray_count = 0;
  size_t group_count = 0;

  size_t axis_x = 0, axis_y = 0, axis_z = 0;
  Vec3f point{};        // axes not permuted
  float toward = 1;     // sign of the depth axis
  float reach = 0;      // largest coordinate of the scene plus that of the point
  float deviation = 0;  // by which rays may pass beside the point, in each coordinate
};

HWY_INLINE void choose_axes(const Vec3f& direction, Bundle& bundle) {
  const Vec3f size(std::abs(direction.x), std::abs(direction.y), std::abs(direction.z));
  const int z = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  bundle.axis_z = static_cast<size_t>(z);
  bundle.axis_x = (bundle.axis_z + 1) % 3;
  bundle.axis_y = (bundle.axis_z + 2) % 3;
  bundle.toward = std::copysign(1.0f, direction[z]);
}

/// Slopes, and those of each group. False where the rays' directions are not similar.
HWY_INLINE bool find_slopes(Bundle& bundle) {
  const Floats d;
  const size_t width = hn::Lanes(d);
  auto low_x = hn::Set(d, greatest_slope), low_y = low_x;
  auto high_x = hn::Set(d, -greatest_slope), high_y = high_x;
  auto in_range = hn::Eq(low_x, low_x);
  for (size_t group = 0; group < bundle.group_count; ++group) {
    const size_t i = group * width;
    const auto speed = hn::Load(d, bundle.speed + i);
    const auto x = hn::Div(hn::Load(d, bundle.direction_x + i), speed);
    const auto y = hn::Div(hn::Load(d, bundle.direction_y + i), speed);
    const auto is_fast = hn::And(hn::Gt(speed, hn::Set(d, least_coordinate)),
                                 hn::Lt(speed, hn::Set(d, greatest_coordinate)));
    const auto is_steep = hn::Le(hn::Max(hn::Abs(x), hn::Abs(y)), hn::Set(d, greatest_slope));
    in_range = hn::And(in_range, hn::And(is_fast, is_steep));
    hn::Store(x, d, bundle.slope_x + i);
    hn::Store(y, d, bundle.slope_y + i);
    const auto group_low_x = hn::MinOfLanes(d, x), group_high_x = hn::MaxOfLanes(d, x);
    const auto group_low_y = hn::MinOfLanes(d, y), group_high_y = hn::MaxOfLanes(d, y);
    bundle.low_x[group] = hn::GetLane(group_low_x);
    bundle.high_x[group] = hn::GetLane(group_high_x);
    bundle.low_y[group] = hn::GetLane(group_low_y);
    bundle.high_y[group] = hn::GetLane(group_high_y);
    low_x = hn::Min(low_x, group_low_x);
    high_x = hn::Max(high_x, group_high_x);
    low_y = hn::Min(low_y, group_low_y);
    high_y = hn::Max(high_y, group_high_y);
  }
  const auto spread = hn::Max(hn::Sub(high_x, low_x), hn::Sub(high_y, low_y));
  return hn::AllTrue(d, in_range) && hn::GetLane(spread) <= greatest_spread;
}

/// No ray has a winner yet. Rays that are not there have the direction of the first, and no hit
/// counts.
HWY_INLINE void fill_last_group(Bundle& bundle) {
  const size_t width = hn::Lanes(Floats());
  std::ranges::fill(bundle.winner, no_winner);
  bundle.group_count = (bundle.ray_count + width - 1) / width;
  for (size_t i = bundle.ray_count; i < bundle.group_count * width; ++i) {
    bundle.direction_x[i] = bundle.direction_x[0];
    bundle.direction_y[i] = bundle.direction_y[0];
    bundle.speed[i] = bundle.speed[0];
    bundle.start[i] = 0;
    bundle.least[i] = bundle.most[i] = nothing_counts;
  }
}

HWY_INLINE void update_group(Bundle& bundle, size_t group) {
  const Floats d;
  const auto most = hn::Load(d, bundle.most + group * hn::Lanes(d));
  bundle.group_most[group] = hn::GetLane(hn::MaxOfLanes(d, most));
}

HWY_INLINE bool is_in_range(const WideTree& tree, const Bundle& bundle) {
  return bundle.reach > least_coordinate && bundle.reach < greatest_coordinate &&
         tree.block_infos.size() < no_winner / hn::Lanes(Floats());
}

HWY_INLINE void set_point(const WideTree& tree, const Vec3f& point, Bundle& bundle) {
  bundle.point = point;
  bundle.reach = largest_component(point) + tree.max_coordinate;
}

/// Bits that a and b do not have in common. Compares without a branch; tells 0 from -0.
HWY_INLINE uint32_t differing_bits(const Vec3f& a, const Vec3f& b) {
  const auto differing = [](float x, float y) {
    return std::bit_cast<uint32_t>(x) ^ std::bit_cast<uint32_t>(y);
  };
  return differing(a.x, b.x) | differing(a.y, b.y) | differing(a.z, b.z);
}

/// Which depths count, of rays from the point.
HWY_INLINE void set_depths(std::span<const Ray> rays, Bundle& bundle) {
  for (size_t i = 0; i < rays.size(); ++i) {
    const auto depth_at = [&](double t) {
      return static_cast<float>(std::min(t, double{FLT_MAX})) * bundle.speed[i];
    };
    bundle.start[i] = depth_at(rays[i].t_min) * (1 + 8 * u);
    bundle.least[i] = depth_at(rays[i].t_max) * (1 - 8 * u);
    bundle.most[i] = depth_at(rays[i].t_max) * (1 + 8 * u);
  }
}

HWY_INLINE void set_all_depths(Bundle& bundle) {
  std::ranges::fill(bundle.start, 0.0f);
  std::ranges::fill(bundle.least, FLT_MAX);
  std::ranges::fill(bundle.most, FLT_MAX);
}

/// Camera rays. False where they have no common origin, point elsewhere or are out of range.
HWY_INLINE bool gather_from_origin(const WideTree& tree, std::span<const Ray> rays,
                                   Bundle& bundle) {
  bundle.ray_count = rays.size();
  if (differing_bits(rays.front().origin, rays.back().origin) != 0) return false;
  set_point(tree, rays[0].origin, bundle);
  choose_axes(rays[rays.size() / 2].direction, bundle);
  if (!is_in_range(tree, bundle)) return false;
  const auto x = static_cast<int>(bundle.axis_x), y = static_cast<int>(bundle.axis_y);
  const auto z = static_cast<int>(bundle.axis_z);
  uint32_t differing = 0;
  uint64_t bounded = 0;
  constexpr auto unbounded = std::bit_cast<uint64_t>(std::numeric_limits<double>::infinity());
  for (size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i];
    differing |= differing_bits(ray.origin, bundle.point);
    bounded |= std::bit_cast<uint64_t>(ray.t_min);
    bounded |= std::bit_cast<uint64_t>(ray.t_max) ^ unbounded;
    const float* const direction = &ray.direction.x;
    bundle.direction_x[i] = direction[x];
    bundle.direction_y[i] = direction[y];
    bundle.speed[i] = direction[z] * bundle.toward;
  }
  if (differing != 0) return false;
  if (bounded == 0) {
    set_all_depths(bundle);
  } else {
    set_depths(rays, bundle);
  }
  fill_last_group(bundle);
  if (!find_slopes(bundle)) return false;
  for (size_t group = 0; group < bundle.group_count; ++group) update_group(bundle, group);
  return true;
}

/// Shadow rays, seen from the point at t_max. False where that is not one point, or as above.
HWY_INLINE bool gather_from_end(const WideTree& tree, std::span<const Ray> rays, Bundle& bundle) {
  bundle.ray_count = rays.size();
  const auto end_of = [](const Ray& ray) {
    return Vec3d(ray.origin) + ray.t_max * Vec3d(ray.direction);
  };
  const Vec3d end = end_of(rays[0]);
  if (!(max_abs(end) < double{greatest_coordinate})) return false;
  set_point(tree, Vec3f(end), bundle);
  const auto distance_from_end = [&](const Ray& ray) {
    return max_abs(end_of(ray) - Vec3d(bundle.point));
  };
  // Not ">", here and below: NaN is no common end.
  if (!(distance_from_end(rays.back()) <= double{8 * u * bundle.reach})) return false;
  choose_axes(-rays[rays.size() / 2].direction, bundle);
  if (!is_in_range(tree, bundle)) return false;
  const auto x = static_cast<int>(bundle.axis_x), y = static_cast<int>(bundle.axis_y);
  const auto z = static_cast<int>(bundle.axis_z);
  double deviation = 0;
  float largest_origin = 0;
  for (const Ray& ray : rays) {
    const double distance = distance_from_end(ray);
    if (!(distance <= double{8 * u * bundle.reach})) return false;
    deviation = std::max(deviation, distance);
    largest_origin = std::max(largest_origin, largest_component(ray.origin));
  }
  if (!(largest_origin < greatest_coordinate)) return false;
  bundle.reach = std::max(bundle.reach, largest_origin + tree.max_coordinate);
  bundle.deviation = static_cast<float>(1.01 * deviation) + FLT_MIN;
  const float pad = 4 * u * bundle.reach;
  for (size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i];
    const float speed = -ray.direction[z] * bundle.toward;
    const double from = (double{ray.origin[z]} - double{bundle.point[z]}) * double{bundle.toward};
    const auto depth_at = [&](double t) {
      return static_cast<float>(std::max(from - t * double{speed}, -0x1p100));
    };
    bundle.direction_x[i] = -ray.direction[x];
    bundle.direction_y[i] = -ray.direction[y];
    bundle.speed[i] = speed;
    bundle.start[i] = std::max(depth_at(ray.t_max), 0.0f) + pad;
    bundle.least[i] = depth_at(ray.t_min) - pad;
    bundle.most[i] = depth_at(ray.t_min) + pad;
  }
  fill_last_group(bundle);
  if (!find_slopes(bundle)) return false;
  for (size_t group = 0; group < bundle.group_count; ++group) update_group(bundle, group);
  return true;
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
