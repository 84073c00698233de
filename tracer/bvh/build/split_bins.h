// SPDX-License-Identifier: MIT
// The surface area heuristic over bins: of centres [Wald 2007], and of space [Stich 2009].
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "tracer/bvh/build/reference.h"
#include "tracer/bvh/build/split_cost.h"
#include "tracer/bvh/primitives.h"

namespace tracer {

/// What would go to either side.
struct SplitSide {
  Box4 bounds;
  uint32_t count = 0;
};

struct SplitCandidate {
  double cost = std::numeric_limits<double>::infinity();  // area * block count of both sides
  int axis = 0;
  int bin = 0;  // the first of the right side
  SplitSide left, right;

  bool exists() const { return cost < std::numeric_limits<double>::infinity(); }
  uint32_t larger_side() const { return std::max(left.count, right.count); }
};

/// The most references that a split may make: of one side, and of both together.
struct SplitLimits {
  uint32_t a_side;
  uint32_t both;
};

/// Bins of one axis. A reference enters at one and leaves at another, which may be the same.
class AxisBins {
 public:
  void clear(int bin_count) { std::fill_n(bins_.begin(), bin_count, Bin{}); }
  void add(int bin, const Box4& box) {
    bins_[bin].bounds.extend(box);
    ++bins_[bin].entries;
    ++bins_[bin].exits;
  }
  void extend(int bin, const Box4& box) { bins_[bin].bounds.extend(box); }
  void enter(int bin) { ++bins_[bin].entries; }
  void leave(int bin) { ++bins_[bin].exits; }
  void merge(const AxisBins& other, int bin_count);
  /// Where a plane along `axis` is cheaper than `best`, or as cheap and more even, it is the best.
  void improve(SplitCandidate& best, int axis, int bin_count, const SplitLimits& limits,
               const BlockCount& block_count) const;

 private:
  struct Bin {
    Box4 bounds;
    uint32_t entries = 0;
    uint32_t exits = 0;

    bool is_untouched() const {
      return entries == 0 && exits == 0 && !(bounds.min[0] <= bounds.max[0]);
    }
  };
  std::array<Bin, max_bin_count> bins_;
};

/// Maps centres to bins.
class CenterGrid {
 public:
  CenterGrid(const Box4& centers, int bin_count);
  int bin_count() const { return bin_count_; }
  Int4 bins_of(Float4 center) const {
    const Float4 position = (center - base_) * scale_;
    // In this order, so that NaN becomes 0.
    const Float4 clamped = min_of(max_of(position, Float4{}), last_bin_);
    return __builtin_convertvector(clamped, Int4);
  }

 private:
  int bin_count_;
  Float4 base_, scale_, last_bin_;
};

class CenterBins {
 public:
  void clear(int bin_count) {
    for (AxisBins& axis : axes_) axis.clear(bin_count);
  }
  void add(std::span<const Reference> references, const CenterGrid& grid);
  void merge(const CenterBins& other, int bin_count);
  SplitCandidate best(const CenterGrid& grid, const SplitLimits& limits,
                      const BlockCount& block_count) const;

 private:
  std::array<AxisBins, 3> axes_;
};

/// Equal slabs of the bounds along their longest side.
class SpaceGrid {
 public:
  static constexpr int bin_count = 16;

  explicit SpaceGrid(const Box& bounds);
  int axis() const { return axis_; }
  /// Between the bins, ascending. None where the bounds are too thin to be cut.
  std::span<const float> planes() const {
    return {planes_.data(), is_too_thin_ ? 0 : planes_.size()};
  }
  /// Adds the part of each reference in each bin to that bin.
  void add(AxisBins& bins, std::span<const Reference> references,
           const Primitives& primitives) const;

 private:
  int guess_bin(float coordinate) const;
  /// Right of every plane that is not above `coordinate`.
  int bin_from(float coordinate) const;
  /// Left of every plane that is not below `coordinate`.
  int bin_up_to(float coordinate) const;

  int axis_;
  bool is_too_thin_ = false;
  std::array<float, bin_count - 1> planes_{};
  double base_, scale_;
};

}  // namespace tracer
