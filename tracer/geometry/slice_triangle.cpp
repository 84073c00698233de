// SPDX-License-Identifier: MIT
#include "tracer/geometry/slice_triangle.h"

#include <algorithm>
#include <cfloat>
#include <utility>

namespace tracer {
namespace {

Float4 all_lanes(float value) {
  return Float4{value, value, value, value};
}

Float4 magnitude_of(Float4 a) {
  return max_of(a, -a);
}

size_t slab_of(float coordinate, std::span<const float> planes) {
  size_t slab = 0;
  while (slab < planes.size() && planes[slab] < coordinate) ++slab;
  return slab;
}

/// From its lower end along `axis` to the higher one; the two differ there.
class Edge {
 public:
  Edge(Float4 low, Float4 high, int axis)
      : start_(low),
        difference_(high - low),
        error_(0x1p-20f * (magnitude_of(low) + magnitude_of(high)) + all_lanes(FLT_MIN)),
        ends_(min_of(low, high), max_of(low, high)),
        axis_lane_{-(axis == 0), -(axis == 1), -(axis == 2), 0},
        axis_start_(low[axis]),
        inverse_length_(1 / (static_cast<double>(high[axis]) - low[axis])) {}

  // An edge ends at its corners, which also keeps what is flat flat. Where the difference is
  // beyond all floats, NaN leaves just that.
  Box4 crossing(float plane) const {
    const auto part =
        static_cast<float>((static_cast<double>(plane) - axis_start_) * inverse_length_);
    const Float4 point = start_ + difference_ * part;
    const Float4 low = max_of(point - error_, ends_.min);
    const Float4 high = min_of(point + error_, ends_.max);
    return {axis_lane_ ? all_lanes(plane) : low, axis_lane_ ? all_lanes(plane) : high};
  }

 private:
  Float4 start_, difference_, error_;
  Box4 ends_;
  Int4 axis_lane_;
  double axis_start_, inverse_length_;
};

}  // namespace

void slice_triangle(const std::array<Vec3f, 3>& corners, int axis, std::span<const float> planes,
                    std::span<Box4> parts) {
  std::ranges::fill(parts, Box4{});
  std::array<size_t, 3> slabs{};
  std::array<Float4, 3> points{};
  for (size_t i = 0; i < 3; ++i) {
    points[i] = Float4{corners[i].x, corners[i].y, corners[i].z, 0};
    slabs[i] = slab_of(corners[i][axis], planes);
    parts[slabs[i]].extend(points[i]);
  }
  for (size_t i = 0; i < 3; ++i) {
    size_t low = i;
    size_t high = (i + 1) % 3;
    if (slabs[low] == slabs[high]) continue;
    if (slabs[low] > slabs[high]) std::swap(low, high);
    const Edge edge(points[low], points[high], axis);
    for (size_t slab = slabs[low]; slab < slabs[high]; ++slab) {
      const Box4 box = edge.crossing(planes[slab]);
      parts[slab].extend(box);
      parts[slab + 1].extend(box);
    }
  }
}

}  // namespace tracer
