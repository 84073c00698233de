// SPDX-License-Identifier: MIT
#include "tracer/bvh/build/split_bins.h"

#include <algorithm>

namespace tracer {

void AxisBins::merge(const AxisBins& other, int bin_count) {
  for (int bin = 0; bin < bin_count; ++bin) {
    bins_[bin].bounds.extend(other.bins_[bin].bounds);
    bins_[bin].entries += other.bins_[bin].entries;
    bins_[bin].exits += other.bins_[bin].exits;
  }
}

void AxisBins::improve(SplitCandidate& best, int axis, int bin_count, const SplitLimits& limits,
                       const BlockCount& block_count) const {
  std::array<double, max_bin_count> right_areas;
  std::array<uint32_t, max_bin_count> right_counts;
  SplitSide right;
  double right_area = 0;
  for (int bin = bin_count - 1; bin > 0; --bin) {
    if (!bins_[bin].is_untouched()) {
      right.bounds.extend(bins_[bin].bounds);
      right.count += bins_[bin].exits;
      right_area = right.bounds.half_area();
    }
    right_areas[bin] = right_area;
    right_counts[bin] = right.count;
  }
  SplitSide left;
  for (int bin = 1; bin < bin_count; ++bin) {
    // Nothing lies between this plane and the one before.
    if (bins_[bin - 1].is_untouched()) continue;
    left.bounds.extend(bins_[bin - 1].bounds);
    left.count += bins_[bin - 1].entries;
    const uint32_t right_count = right_counts[bin];
    const uint32_t larger_side = std::max(left.count, right_count);
    if (left.count == 0 || right_count == 0 || larger_side > limits.a_side ||
        left.count + right_count > limits.both) {
      continue;
    }
    const double cost = left.bounds.half_area() * block_count(left.count) +
                        right_areas[bin] * block_count(right_count);
    if (cost < best.cost || (cost == best.cost && larger_side < best.larger_side())) {
      best = {cost, axis, bin, left, {{}, right_count}};
    }
  }
  if (best.axis != axis || !best.exists()) return;
  for (int bin = best.bin; bin < bin_count; ++bin) best.right.bounds.extend(bins_[bin].bounds);
}

CenterGrid::CenterGrid(const Box4& centers, int bin_count) : bin_count_(bin_count) {
  const auto count = static_cast<float>(bin_count);
  base_ = centers.min;
  last_bin_ = Float4{count - 1, count - 1, count - 1, 0};
  const Float4 size = centers.max - centers.min;
  // No reciprocal of 0: an axis without extent has all in bin 0, as has one beyond all floats.
  scale_ = size > Float4{} ? count / size : Float4{};
}

void CenterBins::add(std::span<const Reference> references, const CenterGrid& grid) {
  for (const Reference& reference : references) {
    const Box4 box = reference.box();
    const Int4 bins = grid.bins_of(center_of(box));
    for (int axis = 0; axis < 3; ++axis) axes_[axis].add(bins[axis], box);
  }
}

void CenterBins::merge(const CenterBins& other, int bin_count) {
  for (int axis = 0; axis < 3; ++axis) axes_[axis].merge(other.axes_[axis], bin_count);
}

SplitCandidate CenterBins::best(const CenterGrid& grid, const SplitLimits& limits,
                                const BlockCount& block_count) const {
  SplitCandidate best;
  for (int axis = 0; axis < 3; ++axis)
    axes_[axis].improve(best, axis, grid.bin_count(), limits, block_count);
  return best;
}

SpaceGrid::SpaceGrid(const Box& bounds)
    : axis_(bounds.longest_axis()),
      base_(bounds.min[axis_]),
      scale_(bin_count / bounds.extent()[axis_]) {
  const double size = bounds.extent()[axis_];
  float previous = bounds.min[axis_];
  for (size_t i = 0; i < planes_.size(); ++i) {
    planes_[i] = static_cast<float>(base_ + size * static_cast<double>(i + 1) / bin_count);
    is_too_thin_ |= !(planes_[i] > previous);
    previous = planes_[i];
  }
  is_too_thin_ |= !(bounds.max[axis_] > previous);
}

int SpaceGrid::guess_bin(float coordinate) const {
  return static_cast<int>(std::clamp((coordinate - base_) * scale_, 0.0, bin_count - 1.0));
}

int SpaceGrid::bin_from(float coordinate) const {
  int bin = guess_bin(coordinate);
  while (bin > 0 && planes_[bin - 1] > coordinate) --bin;
  while (bin + 1 < bin_count && planes_[bin] <= coordinate) ++bin;
  return bin;
}

int SpaceGrid::bin_up_to(float coordinate) const {
  int bin = guess_bin(coordinate);
  while (bin > 0 && planes_[bin - 1] >= coordinate) --bin;
  while (bin + 1 < bin_count && planes_[bin] < coordinate) ++bin;
  return bin;
}

void SpaceGrid::add(AxisBins& bins, std::span<const Reference> references,
                    const Primitives& primitives) const {
  std::array<Box4, bin_count> parts;
  for (const Reference& reference : references) {
    const Box4 box = reference.box();
    const int last = bin_up_to(reference.max[axis_]);
    const int first = std::min(bin_from(reference.min[axis_]), last);
    if (first == last) {
      bins.add(first, box);
      continue;
    }
    // Entries and exits are those of the box: no fewer than a split will make.
    bins.enter(first);
    bins.leave(last);
    const auto crossed = static_cast<size_t>(last - first);
    primitives.slice(reference.primitive, axis_,
                     planes().subspan(static_cast<size_t>(first), crossed),
                     {parts.data(), crossed + 1});
    for (int bin = first; bin <= last; ++bin) {
      const Box4 part = intersection(parts[static_cast<size_t>(bin - first)], box);
      if (!part.is_empty()) bins.extend(bin, part);
    }
  }
}

}  // namespace tracer
