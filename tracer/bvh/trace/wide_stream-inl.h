// SPDX-License-Identifier: MIT
// Rays without anything in common, many under way at a time. [Barringer 2014] All take a step of
// one kind, then all of the next. Steps have few branches that depend on a ray, so that the
// processor works on many at once, and waits neither for one ray's memory nor for its decisions.
#if defined(TRACER_WIDE_STREAM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_WIDE_STREAM_INL_H
#undef TRACER_WIDE_STREAM_INL_H
#else
#define TRACER_WIDE_STREAM_INL_H
#endif

#include <algorithm>
#include <bit>
#include <functional>
#include <span>
#include <utility>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "tracer/bvh/trace/wide_traverse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR

inline size_t ClosestHitsStream(const WideTree&, std::span<const Ray>, const StopFlag&,
                                std::span<Hit>) {
  return 0;
}
inline size_t OccludedStream(const WideTree&, std::span<const Ray>, const StopFlag&,
                             std::span<uint8_t>) {
  return 0;
}

#else

using UintLanes = hn::RebindToUnsigned<Floats>;

/// Distances and children, apart so that a vector of either is stored at once.
struct alignas(64) StreamStack {
  static constexpr uint32_t room = stack_capacity + hn::MaxLanes(Floats());

  uint32_t entries[room];
  // The odd size keeps the tops of many stacks out of the same few lines of a cache.
  uint32_t children[room + 96];
};

/// The first four lanes in descending order.
HWY_INLINE hn::Vec<UintLanes> sort_first_four(hn::Vec<UintLanes> v) {
  const UintLanes du;
  const auto place = hn::And(hn::Iota(du, 0), hn::Set(du, 3));
  const auto keep_larger = [&](hn::Mask<UintLanes> is_larger, hn::Vec<UintLanes> other) {
    return hn::IfThenElse(is_larger, hn::Max(v, other), hn::Min(v, other));
  };
  v = keep_larger(hn::Eq(hn::And(place, hn::Set(du, 1)), hn::Zero(du)), hn::Shuffle2301(v));
  v = keep_larger(hn::Lt(place, hn::Set(du, 2)), hn::Shuffle1032(v));
  // The second with the third; the others are below or above their neighbours already.
  const auto neighbour = hn::OddEven(hn::Shuffle0321(v), hn::Shuffle2103(v));
  const auto is_inner =
      hn::Eq(hn::And(hn::Add(place, hn::Set(du, 1)), hn::Set(du, 2)), hn::Set(du, 2));
  return hn::IfThenElse(is_inner, keep_larger(hn::Eq(place, hn::Set(du, 1)), neighbour), v);
}

template <Query query, Slabs slabs, class Leaf>
class Stream {
 public:
  Stream(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop)
      : tree_(tree), rays_(rays), stop_(stop) {}

  /// Calls answer(index, hit) for each ray up to the first that is out of the filter's range.
  /// Returns how many.
  template <class Answer>
  size_t run(const Answer& answer) {
    for (uint32_t slot = 0; slot < slot_count; ++slot) start_next(slot);
    while (at_node_.count + at_leaf_.count + done_.count > 0 && !stop_.requested()) {
      for (const uint8_t slot : done_.take_all()) {
        answer(slots_[slot].ray, slots_[slot].best);
        start_next(slot);
      }
      if (at_leaf_.count > leaf_batch || at_node_.count == 0) step_leaves();
      step_nodes();
    }
    return next_;
  }

 private:
  // Measured: fewer hide less, more don't fit into a core's first cache.
  static constexpr uint32_t slot_count = 32;
  static constexpr uint32_t leaf_batch = 8;
  static constexpr uint32_t no_child = ~0u;  // at the bottom of each stack

  struct alignas(64) Slot {
    RayConstants constants;
    HitRange range;
    float entry;
    WideChild current;
    uint32_t stack_size;
    uint32_t ray;
    typename Leaf::Found found;  // in the current block
    Hit best;
  };

  /// Slots that wait for a step of one kind.
  struct Queue {
    uint32_t count = 0;
    uint8_t slots[slot_count + 1] = {};  // one more is written and does not count
    uint8_t taken[slot_count];

    HWY_INLINE void add_if(uint32_t condition, uint32_t slot) {
      slots[count] = static_cast<uint8_t>(slot);
      count += condition;
    }
    std::span<const uint8_t> take_all() {
      std::copy_n(slots, slot_count, taken);
      return {taken, std::exchange(count, 0)};
    }
  };

  void start_next(uint32_t index) {
    if (!is_open_ || next_ == rays_.size()) return;
    Slot& slot = slots_[index];
    const Ray& ray = rays_[next_];
    is_open_ = prepare(tree_, ray, slot.constants, TheseSlabs<slabs>());
    if (!is_open_) return;
    slot.range = hit_range<query>(slot.constants, ray);
    slot.entry = slot.constants.t_min;
    slot.current = WideChild::node(0);
    slot.stack_size = 1;
    stacks_[index].children[0] = no_child;
    stacks_[index].entries[0] = 0;
    slot.ray = static_cast<uint32_t>(next_++);
    slot.best = {};
    at_node_.add_if(1, index);
  }

  HWY_INLINE void pop(uint32_t index) {
    Slot& slot = slots_[index];
    const StreamStack& stack = stacks_[index];
    const uint32_t top = --slot.stack_size;
    const WideChild child{stack.children[top]};
    slot.current = child;
    slot.entry = std::bit_cast<float>(stack.entries[top]);
    const bool is_leaf = child.is_leaf();
    if (tree_.is_larger_than_cache) {
      const float* const rows = rows_[is_leaf] + child.index() * strides_[is_leaf];
      for (size_t row = 0; row < WideTree::rows_a_node; ++row) {
        hwy::Prefetch(rows + row * hn::Lanes(Floats()));
      }
      if (tree_.is_larger_than_shared_cache) {
        // Blocks have more rows; a node's first are asked for again.
        const float* const more =
            rows + (is_leaf ? WideTree::rows_a_node * hn::Lanes(Floats()) : 0);
        for (size_t row = 0; row < WideTree::rows_a_block - WideTree::rows_a_node; ++row) {
          hwy::Prefetch(more + row * hn::Lanes(Floats()));
        }
        hwy::Prefetch(&tree_.block_infos[is_leaf ? child.index() : 0]);
      }
    }
    const bool is_done = child.bits == no_child;
    at_node_.add_if(!is_leaf, index);
    at_leaf_.add_if(is_leaf & !is_done, index);
    done_.add_if(is_done, index);
  }

  // What is pushed is popped when all have pushed: a load right behind a wider store waits.
  void step_nodes() {
    const auto slots = at_node_.take_all();
    for (const uint8_t slot : slots) push_children(slots_[slot], stacks_[slot]);
    for (const uint8_t slot : slots) pop(slot);
  }

  // The nearest last, where a closest hit is looked for.
  HWY_INLINE void push_children(Slot& slot, StreamStack& stack) const {
    const UintLanes du;
    const float* node =
        rows_[0] + slot.current.index() * (WideTree::rows_a_node * hn::Lanes(Floats()));
    const auto [near, is_near] = hit_slabs<slabs>(node, slot.constants, slot.range.t_far);
    const auto is_hit = hn::RebindMask(du, is_near);
    const auto count = static_cast<uint32_t>(std::popcount(bits_of(is_near)));
    const auto distances = hn::BitCast(du, near);
    const auto children =
        hn::Load(du, reinterpret_cast<const uint32_t*>(node + 6 * hn::Lanes(Floats())));
    uint32_t* const entries_top = stack.entries + slot.stack_size;
    uint32_t* const children_top = stack.children + slot.stack_size;
    slot.stack_size += count;
    if constexpr (query == Query::occluded) {
      hn::StoreU(hn::Compress(distances, is_hit), du, entries_top);
      hn::StoreU(hn::Compress(children, is_hit), du, children_top);
    } else {
      // The lane in the low bits, as in descend(); zeros come last.
      const auto lane_bits = hn::Set(du, 15);
      const auto keys = hn::Or(hn::AndNot(lane_bits, distances), hn::Iota(du, 0));
      auto sorted = hn::Compress(hn::IfThenElseZero(is_hit, keys), is_hit);
      if (HWY_LIKELY(count <= 4)) {
        sorted = sort_first_four(sorted);
      } else {
        alignas(64) uint32_t key[hn::MaxLanes(Floats())];
        hn::Store(sorted, du, key);
        std::sort(key, key + count, std::greater());
        sorted = hn::Load(du, key);
      }
      const auto lanes = hn::IndicesFromVec(du, hn::And(sorted, lane_bits));
      hn::StoreU(hn::AndNot(lane_bits, sorted), du, entries_top);
      hn::StoreU(hn::TableLookupLanes(children, lanes), du, children_top);
    }
  }

  const float* block_rows(size_t block) const {
    return rows_[1] + block * (WideTree::rows_a_block * hn::Lanes(Floats()));
  }

  void step_leaves() {
    const auto slots = at_leaf_.take_all();
    Queue candidates;
    for (const uint8_t index : slots) {
      Slot& slot = slots_[index];
      const uint32_t block = slot.current.index();
      slot.found = Leaf::template find<query, slabs, Flow::straight>(
          block_rows(block), tree_.block_infos[block], slot.constants, rays_[slot.ray], slot.entry,
          slot.range);
      bool is_asked = slot.found.possible != 0;
      if constexpr (query == Query::occluded) is_asked &= slot.found.certain == 0;
      candidates.add_if(is_asked, index);
    }
    test_exactly(candidates.take_all());
    for (const uint8_t index : slots) {
      Slot& slot = slots_[index];
      bool is_over = false;
      if constexpr (query == Query::occluded) is_over = is_answered(slot);
      if (is_over) slot.stack_size = 1;
      if (HWY_LIKELY(is_over || tree_.block_infos[slot.current.index()].is_last)) {
        pop(index);
      } else {
        ++slot.current.bits;
        at_leaf_.add_if(1, index);
      }
    }
  }

  HWY_INLINE bool is_answered(Slot& slot) const {
    const uint32_t certain = slot.found.certain;
    const int lane = std::countr_zero(certain | 1u << (hn::Lanes(Floats()) - 1));
    const uint32_t primitive = primitive_in(block_rows(slot.current.index()), lane);
    slot.best.primitive = certain != 0 ? primitive : slot.best.primitive;
    return slot.best.is_hit();
  }

  void test_exactly(std::span<const uint8_t> slots) {
    Candidate<typename Leaf::Found> candidates[Leaf::tests_together];
    uint8_t slot_of[Leaf::tests_together];
    size_t count = 0;
    const auto test = [&] {
      Hit hits[Leaf::tests_together];
      Leaf::template hits<query>({candidates, count}, hits);
      for (size_t i = 0; i < count; ++i) keep_closer(hits[i], slot_of[i]);
      count = 0;
    };
    for (const uint8_t index : slots) {
      const Slot& slot = slots_[index];
      const float* rows = block_rows(slot.current.index());
      for (uint32_t bits = slot.found.possible; bits != 0; bits &= bits - 1) {
        slot_of[count] = index;
        candidates[count++] = {&rays_[slot.ray], rows, &slot.found, std::countr_zero(bits)};
        if (count == Leaf::tests_together) test();
      }
    }
    if (count > 0) test();
  }

  void keep_closer(const Hit& hit, uint32_t index) {
    Slot& slot = slots_[index];
    if (!hit.is_hit() || !hit.is_closer_than(slot.best)) return;
    slot.best = hit;
    if constexpr (query == Query::occluded) return;
    slot.range.t_far = std::min(slot.range.t_far, stop_at(slot.constants, hit.t));
    slot.stack_size = cull(slot, stacks_[index]);
  }

  // Drops what lies beyond t_far. Returns what is left.
  static uint32_t cull(const Slot& slot, StreamStack& stack) {
    const Floats d;
    const UintLanes du;
    const auto t_far = hn::Set(d, slot.range.t_far);
    const auto width = static_cast<uint32_t>(hn::Lanes(d));
    uint32_t kept = 0;
    for (uint32_t i = 0; i < slot.stack_size; i += width) {
      const auto entries = hn::LoadU(du, stack.entries + i);
      const auto children = hn::LoadU(du, stack.children + i);
      const auto is_near = hn::RebindMask(du, hn::Le(hn::BitCast(d, entries), t_far));
      const auto is_kept = hn::And(is_near, hn::FirstN(du, slot.stack_size - i));
      hn::StoreU(hn::Compress(entries, is_kept), du, stack.entries + kept);
      hn::StoreU(hn::Compress(children, is_kept), du, stack.children + kept);
      kept += static_cast<uint32_t>(hn::CountTrue(du, is_kept));
    }
    return kept;
  }

  const WideTree& tree_;
  const std::span<const Ray> rays_;
  const StopFlag& stop_;
  // Of nodes, and of blocks.
  const float* const rows_[2] = {tree_.nodes.row(0), tree_.blocks.row(0)};
  const size_t strides_[2] = {WideTree::rows_a_node * hn::Lanes(Floats()),
                              WideTree::rows_a_block* hn::Lanes(Floats())};
  size_t next_ = 0;  // rays before it are answered or under way
  bool is_open_ = true;
  Queue at_node_, at_leaf_, done_;
  Slot slots_[slot_count];
  StreamStack stacks_[slot_count];
};

/// Slabs that pay for the first ray do for most.
template <Query query, class Leaf = ExactLeaf, class Answer>
size_t answer_stream(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                     const Answer& answer) {
  RayConstants constants;
  if (rays.empty() || !prepare(tree, rays[0], constants)) return 0;
  return with_slabs(constants, [&]<Slabs slabs>() {
    return Stream<query, slabs, Leaf>(tree, rays, stop).run(answer);
  });
}

// NOLINTBEGIN(misc-definitions-in-headers): each instruction set has a namespace of its own.
inline size_t ClosestHitsStream(const WideTree& tree, std::span<const Ray> rays,
                                const StopFlag& stop, std::span<Hit> hits) {
  return answer_stream<Query::closest_hit>(tree, rays, stop,
                                           [&](size_t ray, const Hit& hit) { hits[ray] = hit; });
}

inline size_t OccludedStream(const WideTree& tree, std::span<const Ray> rays, const StopFlag& stop,
                             std::span<uint8_t> is_occluded) {
  return answer_stream<Query::occluded>(tree, rays, stop, [&](size_t ray, const Hit& hit) {
    is_occluded[ray] = hit.is_hit() ? 1 : 0;
  });
}
// NOLINTEND(misc-definitions-in-headers)

#endif
}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
