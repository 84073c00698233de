// SPDX-License-Identifier: MIT
#include "tracer/bvh/build/radix_sort.h"

#include <array>
#include <numeric>
#include <utility>

#include "tracer/bvh/build/chunks.h"

namespace tracer {
namespace {

constexpr int digit_bits = 10;
constexpr int digit_count = 3;
constexpr uint32_t bucket_count = 1u << digit_bits;
// Fewer are sorted by comparing.
constexpr uint32_t least_count = 2048;

using Histogram = std::array<uint32_t, bucket_count>;

uint32_t digit(CurveKey key, int place) {
  return key.code >> (place * digit_bits) & (bucket_count - 1);
}

// From counts to where each chunk's first key of each bucket goes.
void make_offsets(std::vector<Histogram>& histograms, uint32_t first) {
  Histogram next{};
  for (const Histogram& histogram : histograms) {
    for (uint32_t bucket = 0; bucket < bucket_count; ++bucket) next[bucket] += histogram[bucket];
  }
  std::exclusive_scan(next.begin(), next.end(), next.begin(), first);
  for (Histogram& histogram : histograms) {
    for (uint32_t bucket = 0; bucket < bucket_count; ++bucket) {
      next[bucket] += std::exchange(histogram[bucket], next[bucket]);
    }
  }
}

void sort_by_digit(std::span<const CurveKey> from, std::span<CurveKey> to, int place,
                   PrimitiveRange range, const Progress& progress) {
  std::vector<Histogram> histograms(chunk_count(range));
  for_each_chunk(range, progress, [&](uint32_t chunk, PrimitiveRange part) {
    Histogram& histogram = histograms[chunk];
    for (uint32_t i = part.begin; i < part.end; ++i) ++histogram[digit(from[i], place)];
  });
  make_offsets(histograms, range.begin);
  for_each_chunk(range, progress, [&](uint32_t chunk, PrimitiveRange part) {
    Histogram& offsets = histograms[chunk];
    for (uint32_t i = part.begin; i < part.end; ++i) to[offsets[digit(from[i], place)]++] = from[i];
  });
}

}  // namespace

void radix_sort(std::span<CurveKey> from, std::span<CurveKey> to, PrimitiveRange range,
                const Progress& progress) {
  if (range.count() < least_count) {
    std::copy(from.begin() + range.begin, from.begin() + range.end, to.begin() + range.begin);
    std::stable_sort(to.begin() + range.begin, to.begin() + range.end,
                     [](CurveKey a, CurveKey b) { return a.code < b.code; });
    return;
  }
  static_assert(digit_count % 2 == 1);  // so that the last pass ends in `to`
  for (int place = 0; place < digit_count; ++place) {
    sort_by_digit(from, to, place, range, progress);
    std::swap(from, to);
  }
}

}  // namespace tracer
