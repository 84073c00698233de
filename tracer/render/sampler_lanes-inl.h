// SPDX-License-Identifier: MIT
#if defined(TRACER_SAMPLER_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_SAMPLER_LANES_INL_H
#undef TRACER_SAMPLER_LANES_INL_H
#else
#define TRACER_SAMPLER_LANES_INL_H
#endif

#include <array>
#include <bit>

#include "tracer/base/lanes-inl.h"
#include "tracer/render/integrator.h"

HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {

using WordTag = hn::CappedTag<uint32_t, 16>;

struct Words {
  hn::Vec<WordTag> v;

  HWY_INLINE explicit Words(uint32_t value) : v(hn::Set(WordTag(), value)) {}
  HWY_INLINE explicit Words(hn::Vec<WordTag> values) : v(values) {}
  static HWY_INLINE Words load(const uint32_t* from) { return Words(hn::LoadU(WordTag(), from)); }
  HWY_INLINE void store(uint32_t* to) const { hn::StoreU(v, WordTag(), to); }

  friend HWY_INLINE Words operator+(Words a, Words b) { return Words(hn::Add(a.v, b.v)); }
  friend HWY_INLINE Words operator*(Words a, Words b) { return Words(hn::Mul(a.v, b.v)); }
  friend HWY_INLINE Words operator^(Words a, Words b) { return Words(hn::Xor(a.v, b.v)); }
  friend HWY_INLINE Words operator|(Words a, Words b) { return Words(hn::Or(a.v, b.v)); }
  friend HWY_INLINE Words operator&(Words a, Words b) { return Words(hn::And(a.v, b.v)); }
  friend HWY_INLINE Words operator>>(Words a, int bits) {
    return Words(hn::ShiftRightSame(a.v, bits));
  }
  friend HWY_INLINE Words operator<<(Words a, int bits) {
    return Words(hn::ShiftLeftSame(a.v, bits));
  }
};

#include "tracer/render/owen_sobol_words-inl.h"

/// The random numbers of a block's samples, as their samplers would give them, many at a time. All
/// samples that still ask for numbers have asked for as many before.
class SamplerLanes {
 public:
  explicit SamplerLanes(std::span<Sampler> samplers) : samplers_(samplers) {
    if (samplers.front().kind() != SamplerKind::sobol) return;
    dimension_ = samplers.front().dimension();
    for (size_t i = 0; i < samplers.size(); ++i) {
      const OwenSobolSample& sample = samplers[i].sobol();
      place_[i] = sample.place();
      order_[i] = sample.order();
      if (i > 0 && sample.square() == samplers[i - 1].sobol().square()) continue;
      run_begin_[run_count_++] = static_cast<uint32_t>(i);
    }
    run_begin_[run_count_] = static_cast<uint32_t>(samplers.size());
  }

  /// Of the samples in ascending order. Writes up to a whole vector beyond `count`.
  void next(const uint32_t* samples, size_t count, double* x) {
    if (run_count_ == 0) {
      for (size_t i = 0; i < count; ++i) x[i] = samplers_[samples[i]].next();
      return;
    }
    find_points(samples, count);
    to_unit(x_, count, x);
  }
  void next_2d(const uint32_t* samples, size_t count, double* x, double* y) {
    if (run_count_ == 0) {
      for (size_t i = 0; i < count; ++i) {
        const Vec2d u = samplers_[samples[i]].next_2d();
        x[i] = u.x;
        y[i] = u.y;
      }
      return;
    }
    find_points(samples, count);
    to_unit(x_, count, x);
    to_unit(y_, count, y);
  }
  /// Lets the samplers themselves go on from here.
  void finish() {
    if (run_count_ == 0) return;
    for (Sampler& sampler : samplers_) sampler.skip_to(dimension_);
  }

 private:
  static constexpr size_t max_size = SampleBlock::max_size;
  // Vectors may begin anywhere.
  using Column = std::array<uint32_t, max_size + 16>;

  void find_points(const uint32_t* samples, size_t count) {
    const uint32_t dimension = dimension_++;
    Column place, order;
    for (size_t i = 0; i < count; ++i) {
      place[i] = place_[samples[i]];
      order[i] = order_[samples[i]];
    }
    for (size_t i = count; i < count + 16; ++i) place[i] = order[i] = 0;
    size_t begin = 0;
    for (size_t run = 0; run < run_count_ && begin < count; ++run) {
      size_t end = begin;
      while (end < count && samples[end] < run_begin_[run + 1]) ++end;
      const OwenSobolSquare& square = samplers_[run_begin_[run]].sobol().square();
      const SobolSeeds seeds = square.seeds(dimension);
      const uint32_t index = square.index(seeds);
      // What lies beyond the end is written again by the next run.
      for (size_t i = begin; i < end; i += hn::Lanes(WordTag())) {
        const Words shift =
            scramble_upwards(Words::load(&place[i]), seeds.place) & Words(pixel_block_size - 1);
        const auto point =
            scrambled_point(index, square.mask(), Words::load(&order[i]), shift_at(shift), seeds);
        point.x.store(&x_[i]);
        point.y.store(&y_[i]);
      }
      begin = end;
    }
  }

  static HWY_INLINE WordPair<Words> shift_at(Words place) {
    const WordTag d;
    const auto offset = hn::BitCast(hn::RebindToSigned<WordTag>(), (place << 1).v);
    const auto* shifts = reinterpret_cast<const uint32_t*>(pixel_shifts.data());
    return {Words(hn::GatherIndex(d, shifts, offset)),
            Words(hn::GatherIndex(d, shifts + 1, offset))};
  }

  static void to_unit(const Column& words, size_t count, double* to) {
    const hn::Rebind<int32_t, LaneTag> di;
    const hn::RebindToUnsigned<decltype(di)> du;
    for (size_t i = 0; i < count; i += hn::Lanes(LaneTag())) {
      const auto digits = hn::ShiftRight<8>(hn::LoadU(du, &words[i]));
      const Lanes value(hn::PromoteTo(LaneTag(), hn::BitCast(di, digits)));
      (value * Lanes(0x1p-24)).store(to + i);
    }
  }

  std::span<Sampler> samplers_;
  uint32_t dimension_ = 0;
  // Of each sample; samples of one square in a row are a run.
  Column place_, order_;
  std::array<uint32_t, max_size + 1> run_begin_;
  size_t run_count_ = 0;  // 0: no Sobol points
  Column x_, y_;
};

}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();

#endif
