// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>

#include "tracer/base/parallel.h"
#include "tracer/base/scratch_array.h"
#include "tracer/bvh/build/bins.h"
#include "tracer/bvh/build/builders.h"
#include "tracer/bvh/build/reference_sides.h"
#include "tracer/bvh/build/small_sweep.h"
#include "tracer/bvh/build/space_route.h"
#include "tracer/bvh/build/split_bins.h"
#include "tracer/bvh/build/subdivide.h"
#include "tracer/bvh/build/tree_part.h"

namespace tracer {
namespace {

// A cut of space is looked for where two children would overlap by more than these parts of the
// root's area [Stich 2009] 4.1 and of their parent's: elsewhere it hardly ever pays.
constexpr double least_overlap_of_root = 0x1p-17;
constexpr double least_overlap_of_parent = 0.1;

/// References in one of two buffers, and the positions that they and their parts may take.
struct ReferenceRange {
  uint32_t region_begin;
  uint32_t region_end;
  uint32_t begin;
  uint32_t end;
  SetBounds bounds;

  uint32_t count() const { return end - begin; }
  uint32_t room() const { return region_end - region_begin; }
};

class SpatialSplitBuild {
 public:
  SpatialSplitBuild(const Primitives& primitives, const BuildSettings& settings, Progress& progress)
      : primitives_(primitives),
        settings_(settings),
        leaf_size_(std::max(settings.leaf_size, 1)),
        max_depth_(std::min(settings.max_depth, max_tree_depth)),
        block_count_(settings),
        progress_(progress) {
    const double budget = primitives.slice ? std::max(settings.split_budget, 0.0) : 0;
    const auto count = static_cast<double>(primitives.boxes.size());
    capacity_ = static_cast<uint32_t>(std::min(count * (1 + budget), 0x7fffffffp0));
    for (auto& buffer : buffers_) buffer = ScratchArray<Reference>(capacity_);
  }

  BvhTree run() {
    if (primitives_.boxes.empty()) return {};
    const ReferenceRange all = all_references();
    root_area_ = all.bounds.boxes.half_area();
    small_costs_.emplace(unit_scale(all.bounds.boxes.box()), settings_);
    const std::unique_ptr<TreePart> root = subtree(all, 0);
    BvhTree tree = join(*root);
    // Parts of a part can be less than it, as all are a little too large.
    if (primitives_.slice) refit(tree);
    return tree;
  }

 private:
  using Children = std::array<ReferenceRange, 2>;

  // A task's own, on the heap as it is large.
  struct Scratch {
    Bins centers;
    SpaceBins space;
  };

  ReferenceRange all_references() {
    const auto count = static_cast<uint32_t>(primitives_.boxes.size());
    parallel_for_ranges(0, count, 16384, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        buffers_[0][i] = Reference(primitives_.boxes[i], static_cast<uint32_t>(i));
      }
    });
    ReferenceRange all{0, capacity_, 0, count, {}};
    std::array<SetBounds, most_chunks> bounds;
    for_each_chunk(references(all, 0), progress_,
                   [&](size_t chunk, std::span<const Reference> part) {
                     for (const Reference& reference : part) bounds[chunk].extend(reference.box());
                   });
    for (const SetBounds& part : bounds) all.bounds.extend(part);
    return all;
  }

  std::span<Reference> references(const ReferenceRange& range, int depth) {
    return {buffers_[depth % 2].data() + range.begin, range.count()};
  }

  std::unique_ptr<TreePart> subtree(const ReferenceRange& range, int depth) {
    auto part = std::make_unique<TreePart>();
    part->nodes.resize(1);
    const auto scratch = std::make_unique<Scratch>();
    if (is_small(references(range, depth)) || is_leaf(range, depth)) {
      subdivide(*part, 0, range, depth, *scratch);
      report_placed(range.room());
      return part;
    }
    part->nodes[0].bounds = range.bounds.boxes.box();
    const Children children = split(range, depth, *scratch);
    do_both([&] { part->left = subtree(children[0], depth + 1); },
            [&] { part->right = subtree(children[1], depth + 1); });
    return part;
  }

  void subdivide(TreePart& part, size_t node, const ReferenceRange& range, int depth,
                 Scratch& scratch) {
    progress_.throw_if_stopped();
    const Box bounds = range.bounds.boxes.box();
    if (is_leaf(range, depth)) {
      part.nodes[node] = {bounds, static_cast<uint32_t>(part.primitives.size()), range.count()};
      for (const Reference& reference : references(range, depth)) {
        part.primitives.push_back(reference.primitive);
      }
      return;
    }
    if (range.count() <= SmallSweep::capacity) return sweep(part, node, range, depth);
    const Children children = split(range, depth, scratch);
    const size_t first = part.nodes.size();
    part.nodes[node] = {bounds, static_cast<uint32_t>(first), 0};
    part.nodes.resize(first + 2);
    subdivide(part, first, children[0], depth + 1, scratch);
    subdivide(part, first + 1, children[1], depth + 1, scratch);
  }

  // So few become a block or two of triangles, for which a second copy of one costs more than it
  // gains: none is cut.
  void sweep(TreePart& part, size_t node, const ReferenceRange& range, int depth) {
    const size_t first = part.primitives.size();
    part.primitives.resize(first + range.count());
    SmallSweep(references(range, depth), range.bounds.half_centers, *small_costs_)
        .subdivide(part.nodes, static_cast<uint32_t>(node), max_depth_ - depth,
                   static_cast<uint32_t>(first), part.primitives.data() + first);
  }

  bool is_leaf(const ReferenceRange& range, int depth) const {
    return depth >= max_depth_ || range.count() <= static_cast<uint32_t>(leaf_size_);
  }

  Children split(const ReferenceRange& range, int depth, Scratch& scratch) {
    const SplitLimits limits{
        side_limit(range.count(), range.room(), leaf_size_, max_depth_ - depth), range.room()};
    Binning binning(range.bounds.half_centers, bin_count_for(range.count(), settings_));
    const SplitCandidate object = split_centers(scratch.centers, binning, range, depth, limits);
    if (is_worth_cutting(range, object)) {
      const Children cut = cut_space(scratch.space, range, depth, limits, object);
      if (cut[0].count() > 0 && cut[1].count() > 0) return cut;
    }
    return object.exists() ? part_centers(binning, object, range, depth) : halve(range, depth);
  }

  SplitCandidate split_centers(Bins& bins, Binning& binning, const ReferenceRange& range, int depth,
                               const SplitLimits& limits) {
    if (!binning.parts_something()) return {};
    const BinSplit split = find_split(
        binning,
        [&](const Binning& with) -> const Bins& {
          bins.clear(with.bin_count());
          gather(bins, range, depth,
                 [&](Bins& into, std::span<const Reference> part) { into.add(part, with); });
          return bins;
        },
        [&](const Bins& of) {
          return of.best_split(block_count_, small_costs_->scale, limits.a_side);
        });
    if (!split.exists()) return {};
    const auto [left, right] = bins.side_bounds(split);
    const uint32_t left_count = bins.left_count(split);
    const uint32_t right_count = range.count() - left_count;
    const double cost =
        left.half_area() * block_count_(left_count) + right.half_area() * block_count_(right_count);
    return {cost, split.axis, split.bin, {left, left_count}, {right, right_count}};
  }

  Children part_centers(const Binning& binning, const SplitCandidate& split,
                        const ReferenceRange& range, int depth) {
    const SideTest goes_right(binning, {.axis = split.axis, .bin = split.bin});
    return distribute(range, depth, [&](const Reference& reference, auto& sink) {
      if (goes_right(reference)[0]) {
        sink.to_right(reference);
      } else {
        sink.to_left(reference);
      }
    });
  }

  bool is_worth_cutting(const ReferenceRange& range, const SplitCandidate& object) const {
    if (!primitives_.slice || range.room() == range.count()) return false;
    if (!object.exists()) return true;
    const double overlap = intersection(object.left.bounds, object.right.bounds).half_area();
    return overlap > least_overlap_of_root * root_area_ &&
           overlap > least_overlap_of_parent * range.bounds.boxes.half_area();
  }

  // Two empty children where no cut costs less.
  Children cut_space(SpaceBins& bins, const ReferenceRange& range, int depth,
                     const SplitLimits& limits, const SplitCandidate& object) {
    const SpaceGrid grid(range.bounds.boxes.box());
    if (grid.planes().empty()) return {};
    bins.clear();
    gather(bins, range, depth, [&](SpaceBins& into, std::span<const Reference> part) {
      grid.add(into, part, primitives_);
    });
    const SplitCandidate best = bins.best_split(grid.axis(), limits, block_count_);
    const double halving_cost = range.bounds.boxes.half_area() * block_count_(range.count());
    if (!(best.cost < std::min(object.cost, halving_cost))) return {};
    const float plane = grid.planes()[static_cast<size_t>(best.bin) - 1];
    return distribute(range, depth, SpaceRoute(best, plane, primitives_, block_count_));
  }

  // The middle of the order along the longest axis of the centres.
  Children halve(const ReferenceRange& range, int depth) {
    const std::span<Reference> all = references(range, depth);
    const int axis = range.bounds.half_centers.box().longest_axis();
    Reference* middle = all.data() + all.size() / 2;
    const auto key = [axis](const Reference& reference) {
      return std::pair(half_center_of(reference.box())[axis], reference.primitive);
    };
    std::nth_element(all.data(), middle, all.data() + all.size(),
                     [&](const Reference& a, const Reference& b) { return key(a) < key(b); });
    return distribute(range, depth, [middle](const Reference& reference, auto& sink) {
      if (&reference < middle) {
        sink.to_left(reference);
      } else {
        sink.to_right(reference);
      }
    });
  }

  // Adds what add(bins, references) makes of the range to bins, which are empty.
  template <class AnyBins, class Add>
  void gather(AnyBins& bins, const ReferenceRange& range, int depth, const Add& add) {
    const std::span<const Reference> all = references(range, depth);
    if (is_small(all)) return add(bins, all);
    std::vector<AnyBins> parts(most_chunks, bins);
    for_each_chunk(all, progress_,
                   [&](size_t chunk, std::span<const Reference> part) { add(parts[chunk], part); });
    for (const AnyBins& part : parts) bins.add(part);
  }

  template <class Route>
  Children distribute(const ReferenceRange& range, int depth, const Route& route) {
    Reference* const target = buffers_[(depth + 1) % 2].data();
    const SideWriter written =
        write_sides(references(range, depth),
                    {target + range.region_begin, target + range.region_end}, progress_, route);
    return children_of(range, written, target);
  }

  // What room is left goes to the children as their areas times counts. [Ganestam 2015]
  static Children children_of(const ReferenceRange& range, const SideWriter& written,
                              const Reference* target) {
    const auto left_end = static_cast<uint32_t>(written.left - target);
    const auto right_begin = static_cast<uint32_t>(written.right - target);
    const double left_weight =
        written.left_bounds.boxes.half_area() * (left_end - range.region_begin);
    const double right_weight =
        written.right_bounds.boxes.half_area() * (range.region_end - right_begin);
    const double weight = left_weight + right_weight;
    const double left_part = weight > 0 ? left_weight / weight : 0.5;
    const uint32_t border = left_end + static_cast<uint32_t>(left_part * (right_begin - left_end));
    return {ReferenceRange{range.region_begin, border, range.region_begin, left_end,
                           written.left_bounds},
            ReferenceRange{border, range.region_end, right_begin, range.region_end,
                           written.right_bounds}};
  }

  void report_placed(uint32_t room) {
    const uint32_t placed = placed_.fetch_add(room, std::memory_order_relaxed) + room;
    progress_.set_fraction(static_cast<double>(placed) / capacity_);
  }

  const Primitives& primitives_;
  const BuildSettings settings_;
  const int leaf_size_;
  const int max_depth_;
  const BlockCount block_count_;
  Progress& progress_;
  uint32_t capacity_;
  double root_area_ = 0;
  std::optional<SmallSweep::Costs> small_costs_;
  std::array<ScratchArray<Reference>, 2> buffers_;
  std::atomic<uint32_t> placed_{0};
};

}  // namespace

BvhTree build_spatial_split(const Primitives& primitives, const BuildSettings& settings,
                            Progress& progress) {
  return SpatialSplitBuild(primitives, settings, progress).run();
}

}  // namespace tracer
