// SPDX-License-Identifier: MIT
// What builders by the surface area heuristic share: areas, what is counted, what depth allows.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tracer/bvh/build_settings.h"
#include "tracer/geometry/box4.h"

namespace tracer {

/// The most primitives either side of `count` may have, so that the levels below it can reach the
/// leaf size; `room`, of which cuts may make so many, where they cannot in any case. levels_left >=
/// 1 are allowed below the node.
inline uint32_t side_limit(uint32_t count, uint32_t room, int leaf_size, int levels_left) {
  const uint64_t limit = static_cast<uint64_t>(leaf_size) << std::min(levels_left - 1, 32);
  return count <= 2 * limit ? static_cast<uint32_t>(std::min<uint64_t>(limit, room)) : room;
}
/// Where nothing is cut.
inline uint32_t side_limit(uint32_t count, int leaf_size, int levels_left) {
  return side_limit(count, count, leaf_size, levels_left);
}

inline constexpr int max_bin_count = 64;

/// Bins along each axis for the centres of `count` primitives: as many as the settings say, fewer
/// where a finer split will follow soon.
inline int bin_count_for(uint32_t count, const BuildSettings& settings) {
  const int most = std::clamp(settings.bins, 2, max_bin_count);
  return static_cast<int>(std::min(static_cast<uint32_t>(most), 4 + count / 16));
}

/// What the heuristic counts in a node: its blocks of primitives that are tested at once, the last
/// of which need not be full.
class BlockCount {
 public:
  explicit BlockCount(const BuildSettings& settings)
      : block_size_(static_cast<float>(std::max(settings.block_size, 1))) {}

  /// Exact up to 2^22 primitives.
  Float4 operator()(Int4 primitive_counts) const {
    const Float4 counts = __builtin_convertvector(primitive_counts, Float4);
    if (block_size_ == 1) return counts;
    const Float4 blocks = (counts + (block_size_ - 0.5f)) * (1 / block_size_);
    return __builtin_convertvector(__builtin_convertvector(blocks, Int4), Float4);
  }
  float operator()(uint32_t primitive_count) const {
    return (*this)(Int4{} + static_cast<int32_t>(primitive_count))[0];
  }

 private:
  float block_size_;
};

/// The power of two that brings all coordinates of a finite box below 1, so that areas and costs
/// of scaled boxes do not overflow; at most 2^126.
inline float unit_scale(const Box& box) {
  const double largest = std::max(max_abs(Vec3d(box.min)), max_abs(Vec3d(box.max)));
  int exponent = -126;
  if (largest > 0) std::frexp(largest, &exponent);
  return std::ldexp(1.0f, std::min(-exponent, 126));
}

inline Box4 scaled(const Box4& box, float scale) {
  return {box.min * scale, box.max * scale};
}

/// Half the areas of three boxes, in lanes 0 to 2; of an empty one, infinite or NaN.
inline Float4 half_areas(const Box4& a, const Box4& b, const Box4& c) {
  const auto faces = [](const Box4& box) {
    const Float4 size = box.max - box.min;
    return size * __builtin_shufflevector(size, size, 1, 2, 0, 3);
  };
  const Float4 of_a = faces(a), of_b = faces(b), of_c = faces(c);
  // Transposed, so that the three faces of a box add up in its lane.
  const Float4 first_two = __builtin_shufflevector(of_a, of_b, 0, 4, 1, 5);
  const Float4 last = __builtin_shufflevector(of_a, of_b, 2, 6, 3, 7);
  return __builtin_shufflevector(first_two, of_c, 0, 1, 4, 4) +
         __builtin_shufflevector(first_two, of_c, 2, 3, 5, 5) +
         __builtin_shufflevector(last, of_c, 0, 1, 6, 6);
}

/// The cheapest split seen on each of three axes, in lanes 0 to 2; the most even of equals.
class BestSplits {
 public:
  /// areas * blocks of both sides is the cost; NaN and infinity are never taken.
  void offer(Float4 left_areas, Float4 left_blocks, Float4 right_areas, Float4 right_blocks,
             Int4 larger_side, Int4 is_allowed, int place) {
    // Arranged so that boxes that are all the same cost the same at every plane of as many blocks.
    const Float4 cost =
        right_areas * (left_blocks + right_blocks) + (left_areas - right_areas) * left_blocks;
    const Int4 is_better =
        is_allowed & ((cost < cost_) | ((cost == cost_) & (larger_side < larger_side_)));
    cost_ = is_better ? cost : cost_;
    larger_side_ = is_better ? larger_side : larger_side_;
    place_ = is_better ? Int4{} + place : place_;
  }

  /// The lowest axis of equals. There is none where place() is 0.
  int axis() const {
    int best = 0;
    for (int axis = 1; axis < 3; ++axis) {
      const bool is_equal = cost_[axis] == cost_[best];
      if (is_equal ? larger_side_[axis] < larger_side_[best] : cost_[axis] < cost_[best]) {
        best = axis;
      }
    }
    return best;
  }
  int place() const { return place_[axis()]; }
  float cost() const { return cost_[axis()]; }

 private:
  Float4 cost_ = Float4{} + std::numeric_limits<float>::infinity();
  Int4 larger_side_{};
  Int4 place_{};
};

}  // namespace tracer
