// SPDX-License-Identifier: MIT
#include "tracer/bvh/build/bins.h"

namespace tracer {

std::optional<Binning> Binning::finer(const Bins& bins) const {
  const uint32_t all = bins.left_count({.axis = 0, .bin = bin_count_});
  const auto is_crowded = [&](uint32_t count) {
    return count > all / 2 &&
           uint64_t{count} * static_cast<uint32_t>(bin_count_) > 8 * uint64_t{all};
  };
  const float times = static_cast<float>(max_bin_count) / static_cast<float>(bin_count_);
  Binning finer = *this;
  finer.bin_count_ = max_bin_count;
  const Float4 scales = scale_ * times;
  finer.scale_ = scales < Box4::infinity ? scales : Float4{};
  bool is_finer = false;
  for (int axis = 0; axis < 3; ++axis) {
    const int fullest = bins.fullest(axis);
    const float scale = scale_[axis] * static_cast<float>(max_bin_count);
    if (scale_[axis] == 0 || !(scale < Box4::infinity) || !is_crowded(bins.count(axis, fullest))) {
      continue;
    }
    finer.origin_[axis] += static_cast<float>(fullest) / scale_[axis];
    finer.scale_[axis] = scale;
    is_finer = true;
  }
  if (!is_finer) return {};
  return finer;
}

void Bins::clear(int bin_count) {
  bin_count_ = bin_count;
  for (int i = 0; i < bin_count; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      bins_[i].min[axis] = Float4{} + Box4::infinity;
      bins_[i].max[axis] = Float4{} - Box4::infinity;
    }
    for (uint32_t& count : bins_[i].counts) count = 0;
  }
}

void Bins::add(std::span<const Reference> references, const Binning& binning) {
  for (const Reference& reference : references) {
    const Box4 box = reference.box();
    const Int4 indices = binning.bins(box);
    for (int axis = 0; axis < 3; ++axis) {
      Bin& bin = bins_[static_cast<uint32_t>(indices[axis])];
      bin.extend(axis, box);
      ++bin.counts[axis];
    }
  }
}

void Bins::add(const Bins& other) {
  for (int i = 0; i < bin_count_; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      bins_[i].extend(axis, other.bins_[i].box(axis));
      bins_[i].counts[axis] += other.bins_[i].counts[axis];
    }
  }
}

BinSplit Bins::best_split(const BlockCount& block_count, float scale, uint32_t limit) const {
  Box4 x, y, z;
  Int4 count{};
  const auto extend = [&](const Bin& bin) {
    x.extend(scaled(bin.box(0), scale));
    y.extend(scaled(bin.box(1), scale));
    z.extend(scaled(bin.box(2), scale));
    count += bin.count_lanes();
  };
  Float4 right_areas[max_bin_count];
  Int4 right_counts[max_bin_count];
  for (int i = bin_count_ - 1; i > 0; --i) {
    extend(bins_[i]);
    right_areas[i] = half_areas(x, y, z);
    right_counts[i] = count;
  }
  x = y = z = Box4();
  count = Int4{};
  const Int4 limits = Int4{} + static_cast<int32_t>(limit);
  BestSplits best;
  for (int i = 1; i < bin_count_; ++i) {
    extend(bins_[i - 1]);
    const Int4 larger_side = count > right_counts[i] ? count : right_counts[i];
    const Int4 is_allowed = (count > 0) & (right_counts[i] > 0) & (larger_side <= limits);
    best.offer(half_areas(x, y, z), block_count(count), right_areas[i],
               block_count(right_counts[i]), larger_side, is_allowed, i);
  }
  return {best.axis(), best.place(), best.cost()};
}

int Bins::fullest(int axis) const {
  int fullest = 0;
  for (int i = 1; i < bin_count_; ++i) {
    if (count(axis, i) > count(axis, fullest)) fullest = i;
  }
  return fullest;
}

uint32_t Bins::left_count(BinSplit split) const {
  uint32_t count = 0;
  for (int i = 0; i < split.bin; ++i) count += bins_[i].counts[split.axis];
  return count;
}

std::array<Box4, 2> Bins::side_bounds(BinSplit split) const {
  std::array<Box4, 2> bounds;
  for (int i = 0; i < bin_count_; ++i) {
    bounds[i < split.bin ? 0 : 1].extend(bins_[i].box(split.axis));
  }
  return bounds;
}

}  // namespace tracer
