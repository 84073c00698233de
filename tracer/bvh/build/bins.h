// SPDX-License-Identifier: MIT
// Primitives counted by where their centres lie, and the best plane between two bins. [Wald 2007]
#pragma once

#include <array>
#include <bit>
#include <limits>
#include <optional>
#include <span>

#include "tracer/bvh/build/reference.h"
#include "tracer/bvh/build/split_cost.h"

namespace tracer {

/// Left are the bins below `bin` along `axis`.
struct BinSplit {
  int axis = 0;
  int bin = 0;
  float cost = std::numeric_limits<float>::infinity();  // area * blocks of both sides

  bool exists() const { return bin > 0; }
};

class Bins;

/// Equal bins along each axis over the bounds of half centres; an axis along which they cannot be
/// told apart has one bin. What lies beyond them counts in the first and the last bin.
class Binning {
 public:
  Binning(const Box4& half_centers, int bin_count)
      : bin_count_(bin_count), origin_(half_centers.min) {
    // A little less, so that the last centre falls into the last bin after rounding.
    const Float4 scale = (static_cast<float>(bin_count) * 0.9999f) / (half_centers.max - origin_);
    scale_ = scale < Box4::infinity ? scale : Float4{};
  }

  int bin_count() const { return bin_count_; }
  bool parts_something() const { return scale_[0] + scale_[1] + scale_[2] > 0; }
  Int4 bins(const Box4& box) const {
    const Float4 position = (half_center_of(box) - origin_) * scale_;
    const Float4 last = Float4{} + static_cast<float>(bin_count_ - 1);
    return __builtin_convertvector(min_of(max_of(position, Float4{}), last), Int4);
  }
  /// Axes whose fullest bin holds more than half of the primitives, and more than eight bins
  /// would if they were spread evenly, have all their bins there, so
  /// that a dense model on a wide floor is told apart from it. Nothing where there is none.
  std::optional<Binning> finer(const Bins& bins) const;

 private:
  friend class SideTest;

  int bin_count_;
  Float4 origin_;
  Float4 scale_;
};

/// Whether a centre lies right of a split, in all lanes; decided by the same bits as its bin.
class SideTest {
 public:
  SideTest(const Binning& binning, BinSplit split)
      : axis_(split.axis),
        origin_(Float4{} + binning.origin_[axis_]),
        scale_(Float4{} + binning.scale_[axis_]),
        bin_(Float4{} + static_cast<float>(split.bin)) {}

  Int4 operator()(const Reference& reference) const {
    const Float4 min = Float4{} + reference.min[axis_];
    const Float4 max = Float4{} + reference.max[axis_];
    return (half_center_of({min, max}) - origin_) * scale_ >= bin_;
  }

 private:
  int axis_;
  Float4 origin_;
  Float4 scale_;
  Float4 bin_;
};

/// Counts and bounds of the primitives in each bin. Nothing is initialised until cleared.
class Bins {
 public:
  void clear(int bin_count);
  void add(std::span<const Reference> references, const Binning& binning);
  void add(const Bins& other);

  /// The cheapest plane that leaves something, and at most `limit`, on each side; the most even of
  /// equals. Areas are taken of boxes scaled by `scale`.
  BinSplit best_split(const BlockCount& block_count, float scale, uint32_t limit) const;
  uint32_t left_count(BinSplit split) const;
  int fullest(int axis) const;
  uint32_t count(int axis, int bin) const { return bins_[static_cast<size_t>(bin)].counts[axis]; }
  std::array<Box4, 2> side_bounds(BinSplit split) const;

 private:
  struct alignas(128) Bin {
    Float4 min[3];  // by axis
    Float4 max[3];
    uint32_t counts[4];

    Box4 box(int axis) const { return {min[axis], max[axis]}; }
    void extend(int axis, const Box4& box) {
      min[axis] = min_of(box.min, min[axis]);
      max[axis] = max_of(box.max, max[axis]);
    }
    Int4 count_lanes() const { return std::bit_cast<Int4>(counts); }
  };

  int bin_count_;
  std::array<Bin, max_bin_count> bins_;
};

/// The best plane over `binning`, or over finer ones as long as they gain: gather(binning) returns
/// a reference to its Bins, and best_split(bins) their BinSplit. `binning` and what was gathered
/// last become those of the result.
template <class Gather, class BestSplit>
BinSplit find_split(Binning& binning, const Gather& gather, const BestSplit& best_split) {
  // Each round costs another look at all.
  constexpr int most_finer_rounds = 3;
  const Bins* bins = &gather(binning);
  BinSplit split = best_split(*bins);
  for (int round = 0; round < most_finer_rounds; ++round) {
    const std::optional<Binning> finer = binning.finer(*bins);
    if (!finer) break;
    bins = &gather(*finer);
    const BinSplit candidate = best_split(*bins);
    if (!(candidate.cost < split.cost)) {
      gather(binning);
      break;
    }
    binning = *finer;
    split = candidate;
  }
  return split;
}

}  // namespace tracer
