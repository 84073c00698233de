// SPDX-License-Identifier: MIT
#include "tracer/bvh/build/radix_sort.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "tracer/bvh/build/chunks.h"

namespace tracer {
namespace {

// Fewer are sorted by comparing.
constexpr uint32_t least_count = 2048;
// A digit's counts stay in the first cache.
constexpr int most_digit_bits = 12;

class Digits {
 public:
  Digits(int digit_bits, int place) : shift_(place * digit_bits), mask_((1u << digit_bits) - 1) {}

  uint32_t count() const { return mask_ + 1; }
  uint32_t of(CurveKey key) const { return key.code >> shift_ & mask_; }

 private:
  int shift_;
  uint32_t mask_;
};

// From counts, by chunk and digit, to where each chunk's first key of each digit goes.
void make_offsets(std::span<uint32_t> counts, uint32_t digit_count) {
  uint32_t next = 0;
  for (uint32_t digit = 0; digit < digit_count; ++digit) {
    for (size_t i = digit; i < counts.size(); i += digit_count) {
      next += std::exchange(counts[i], next);
    }
  }
}

void sort_by_digit(std::span<const CurveKey> from, std::span<CurveKey> to, Digits digits,
                   const Progress& progress) {
  const PrimitiveRange all{0, static_cast<uint32_t>(from.size())};
  std::vector<uint32_t> offsets(size_t{chunk_count(all)} * digits.count());
  const auto of_chunk = [&](uint32_t chunk) { return &offsets[size_t{chunk} * digits.count()]; };
  for_each_chunk(all, progress, [&](uint32_t chunk, PrimitiveRange part) {
    uint32_t* const counts = of_chunk(chunk);
    for (uint32_t i = part.begin; i < part.end; ++i) ++counts[digits.of(from[i])];
  });
  make_offsets(offsets, digits.count());
  for_each_chunk(all, progress, [&](uint32_t chunk, PrimitiveRange part) {
    uint32_t* const next = of_chunk(chunk);
    for (uint32_t i = part.begin; i < part.end; ++i) to[next[digits.of(from[i])]++] = from[i];
  });
}

}  // namespace

std::span<const CurveKey> radix_sort(std::span<CurveKey> keys, std::span<CurveKey> scratch,
                                     int code_bits, const Progress& progress) {
  if (keys.size() < least_count) {
    std::ranges::stable_sort(keys, {}, &CurveKey::code);
    return keys;
  }
  const int digit_count = (code_bits + most_digit_bits - 1) / most_digit_bits;
  const int digit_bits = (code_bits + digit_count - 1) / digit_count;
  for (int place = 0; place < digit_count; ++place) {
    sort_by_digit(keys, scratch, Digits(digit_bits, place), progress);
    std::swap(keys, scratch);
  }
  return keys;
}

}  // namespace tracer
