// SPDX-License-Identifier: MIT
#include "tracer/bvh/build/split_bins.h"

#include <algorithm>

namespace tracer {
namespace {

constexpr int bin_count = SpaceBins::bin_count;

}  // namespace

void SpaceBins::add(const SpaceBins& other) {
  for (int bin = 0; bin < bin_count; ++bin) {
    bins_[bin].bounds.extend(other.bins_[bin].bounds);
    bins_[bin].entries += other.bins_[bin].entries;
    bins_[bin].exits += other.bins_[bin].exits;
  }
}

SplitCandidate SpaceBins::best_split(int axis, const SplitLimits& limits,
                                     const BlockCount& block_count) const {
  std::array<double, bin_count> right_areas;
  std::array<uint32_t, bin_count> right_counts;
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
  SplitCandidate best;
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
  if (!best.exists()) return best;
  for (int bin = best.bin; bin < bin_count; ++bin) best.right.bounds.extend(bins_[bin].bounds);
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

void SpaceGrid::add(SpaceBins& bins, std::span<const Reference> references,
                    const Primitives& primitives) const {
  // What is cut lies anywhere in memory, so it is asked for a group at a time.
  constexpr size_t group_size = 16;
  std::array<BinRange, group_size> ranges;
  for (size_t begin = 0; begin < references.size(); begin += group_size) {
    const auto group = references.subspan(begin, std::min(group_size, references.size() - begin));
    for (size_t i = 0; i < group.size(); ++i) {
      ranges[i] = bins_of(group[i]);
      if (ranges[i].first < ranges[i].last) primitives.prefetch(group[i].primitive);
    }
    for (size_t i = 0; i < group.size(); ++i) {
      if (ranges[i].first == ranges[i].last) {
        bins.add(ranges[i].first, group[i].box());
      } else {
        add_parts(bins, group[i], ranges[i], primitives);
      }
    }
  }
}

SpaceGrid::BinRange SpaceGrid::bins_of(const Reference& reference) const {
  const int last = bin_up_to(reference.max[axis_]);
  return {std::min(bin_from(reference.min[axis_]), last), last};
}

void SpaceGrid::add_parts(SpaceBins& bins, const Reference& reference, BinRange range,
                          const Primitives& primitives) const {
  const auto [first, last] = range;
  // Entries and exits are those of the box: no fewer than a split will make.
  bins.enter(first);
  bins.leave(last);
  std::array<Box4, bin_count> parts;
  const Box4 box = reference.box();
  const auto crossed = static_cast<size_t>(last - first);
  primitives.slice(reference.primitive, axis_,
                   planes().subspan(static_cast<size_t>(first), crossed),
                   {parts.data(), crossed + 1});
  for (int bin = first; bin <= last; ++bin) {
    const Box4 part = intersection(parts[static_cast<size_t>(bin - first)], box);
    if (!part.is_empty()) bins.extend(bin, part);
  }
}

}  // namespace tracer
