// SPDX-License-Identifier: MIT
// The surface area heuristic over bins of space. [Stich 2009]
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

/// A reference enters at one bin and leaves at another, which may be the same.
class SpaceBins {
 public:
  static constexpr int bin_count = 16;

  void clear() { bins_.fill({}); }
  void add(int bin, const Box4& box) {
    bins_[bin].bounds.extend(box);
    ++bins_[bin].entries;
    ++bins_[bin].exits;
  }
  void extend(int bin, const Box4& box) { bins_[bin].bounds.extend(box); }
  void enter(int bin) { ++bins_[bin].entries; }
  void leave(int bin) { ++bins_[bin].exits; }
  void add(const SpaceBins& other);
  /// The cheapest plane between two bins; the most even of equals.
  SplitCandidate best_split(int axis, const SplitLimits& limits,
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
  std::array<Bin, bin_count> bins_;
};

/// Equal slabs of the bounds along their longest side.
class SpaceGrid {
 public:
  explicit SpaceGrid(const Box& bounds);
  int axis() const { return axis_; }
  /// Between the bins, ascending. None where the bounds are too thin to be cut.
  std::span<const float> planes() const {
    return {planes_.data(), is_too_thin_ ? 0 : planes_.size()};
  }
  /// Adds the part of each reference in each bin to that bin.
  void add(SpaceBins& bins, std::span<const Reference> references,
           const Primitives& primitives) const;

 private:
  struct BinRange {
    int first;
    int last;
  };

  BinRange bins_of(const Reference& reference) const;
  void add_parts(SpaceBins& bins, const Reference& reference, BinRange range,
                 const Primitives& primitives) const;
  int guess_bin(float coordinate) const;
  /// Right of every plane that is not above `coordinate`.
  int bin_from(float coordinate) const;
  /// Left of every plane that is not below `coordinate`.
  int bin_up_to(float coordinate) const;

  int axis_;
  bool is_too_thin_ = false;
  std::array<float, SpaceBins::bin_count - 1> planes_{};
  double base_, scale_;
};

}  // namespace tracer
