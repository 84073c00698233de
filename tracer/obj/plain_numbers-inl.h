// SPDX-License-Identifier: MIT
// A line's numbers all at once: one look at 64 bytes finds where they stand, and digits become
// values sixteen at a time. Each function reads up to 128 bytes from where it begins, and 16
// before.
#if defined(TRACER_PLAIN_NUMBERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACER_PLAIN_NUMBERS_INL_H
#undef TRACER_PLAIN_NUMBERS_INL_H
#else
#define TRACER_PLAIN_NUMBERS_INL_H
#endif

#include <array>
#include <bit>
#include <cstdint>

#include <hwy/highway.h>

#include "tracer/obj/scan_number.h"
#include "tracer/obj/text_cursor.h"

#undef TRACER_HAS_PLAIN_NUMBERS
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_SSE4
#define TRACER_HAS_PLAIN_NUMBERS
#include <immintrin.h>
#endif

#ifdef TRACER_HAS_PLAIN_NUMBERS
HWY_BEFORE_NAMESPACE();
namespace tracer {
namespace HWY_NAMESPACE {

/// Bit i stands for byte i of 64.
struct ByteKinds {
  uint64_t others;  // neither digit nor '-'
  uint64_t minuses;
};

#if HWY_TARGET <= HWY_AVX2
HWY_INLINE ByteKinds kinds_of_32(const char* at) {
  const __m256i bytes = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(at));
  const __m256i values = _mm256_sub_epi8(bytes, _mm256_set1_epi8('0'));
  const __m256i is_digit = _mm256_cmpeq_epi8(_mm256_min_epu8(values, _mm256_set1_epi8(9)), values);
  const __m256i is_minus = _mm256_cmpeq_epi8(bytes, _mm256_set1_epi8('-'));
  const auto bits_of = [](__m256i mask) {
    return static_cast<uint32_t>(_mm256_movemask_epi8(mask));
  };
  return {~bits_of(_mm256_or_si256(is_digit, is_minus)), bits_of(is_minus)};
}
#else
HWY_INLINE ByteKinds kinds_of_16(const char* at) {
  const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(at));
  const __m128i values = _mm_sub_epi8(bytes, _mm_set1_epi8('0'));
  const __m128i is_digit = _mm_cmpeq_epi8(_mm_min_epu8(values, _mm_set1_epi8(9)), values);
  const __m128i is_minus = _mm_cmpeq_epi8(bytes, _mm_set1_epi8('-'));
  const auto bits_of = [](__m128i mask) { return static_cast<uint32_t>(_mm_movemask_epi8(mask)); };
  return {bits_of(_mm_or_si128(is_digit, is_minus)) ^ 0xffffu, bits_of(is_minus)};
}

HWY_INLINE ByteKinds kinds_of_32(const char* at) {
  const ByteKinds low = kinds_of_16(at);
  const ByteKinds high = kinds_of_16(at + 16);
  return {low.others | high.others << 16, low.minuses | high.minuses << 16};
}
#endif

HWY_INLINE ByteKinds kinds_of_64(const char* at) {
  const ByteKinds low = kinds_of_32(at);
  const ByteKinds high = kinds_of_32(at + 32);
  return {low.others | high.others << 32, low.minuses | high.minuses << 32};
}

/// The place of the lowest bit, which is taken; 64 where there is none.
HWY_INLINE int take_lowest(uint64_t& bits) {
  const int place = std::countr_zero(bits);
  bits &= bits - 1;
  return place;
}

/// The bytes of a number up to `end`: digits, and a point before the last `part_count` of them.
struct DecimalPlace {
  int end;
  int digit_count;
  int part_count;
  bool is_negative;
};

/// Finds `count` numbers with one blank between each and the next: digits on both sides of a point,
/// 15 at most. The line's end, which stands behind the last; nullptr where the line is another.
template <int count>
HWY_INLINE const char* find_decimals(const char* at, std::array<DecimalPlace, count>& places) {
  const ByteKinds kinds = kinds_of_64(at);
  uint64_t ends = kinds.others;
  uint64_t begins = 0;
  int begin = 0;
  int faults = 0;      // negative where counts are wrong
  int wrong_byte = 0;  // not zero where another byte stands between
  for (int i = 0; i < count; ++i) {
    const int point = take_lowest(ends);
    const int end = take_lowest(ends);
    const bool is_negative = (kinds.minuses >> (begin & 63) & 1) != 0;
    begins |= uint64_t{1} << (begin & 63);
    const int digit_count = end - begin - 1 - is_negative;
    const int part_count = end - point - 1;
    places[i] = {end, digit_count, part_count, is_negative};
    faults |= (digit_count - part_count - 1) | (part_count - 1) | (15 - digit_count);
    wrong_byte |= at[point] ^ '.';
    if (i + 1 < count) wrong_byte |= at[end] ^ ' ';
    begin = end + 1;
  }
  const int end = places[count - 1].end;
  if (faults < 0 || wrong_byte != 0 || end == 64 || !is_line_end(at[end])) return nullptr;
  const uint64_t inner = kinds.minuses & ~begins;
  return std::countr_zero(inner) < end ? nullptr : at + end;
}

/// [i] moves the digits around a point that has i behind it together, at the end of 16 bytes.
alignas(64) inline constexpr auto without_point = [] {
  std::array<std::array<int8_t, 16>, 16> bytes{};
  for (int part_count = 0; part_count < 16; ++part_count) {
    for (int i = 0; i < 16; ++i) {
      bytes[part_count][i] = static_cast<int8_t>(i >= 16 - part_count ? i : i - 1);
    }
  }
  return bytes;
}();

/// 16 bytes from [i] on leave the values of the last i digits.
alignas(64) inline constexpr auto last_of_16 = [] {
  std::array<int8_t, 32> bytes{};
  for (int i = 16; i < 32; ++i) bytes[i] = 0x0f;
  return bytes;
}();

/// What a number is divided by; [1] is for negative ones.
inline constexpr auto signed_powers_of_ten = [] {
  std::array<std::array<double, 16>, 2> powers{};
  for (int i = 0; i < 16; ++i) {
    powers[0][i] = scan_detail::powers_of_ten[i];
    powers[1][i] = -scan_detail::powers_of_ten[i];
  }
  return powers;
}();

/// Four groups of four digits, each as its value, from the values of 16.
HWY_INLINE __m128i groups_of_four(__m128i digits) {
  const __m128i pairs = _mm_maddubs_epi16(digits, _mm_set1_epi16(0x010a));
  return _mm_madd_epi16(pairs, _mm_set1_epi32(0x00010064));
}

/// Groups of eight, from groups of four: those of `a`, then those of `b`.
HWY_INLINE __m128i groups_of_eight(__m128i a, __m128i b) {
  return _mm_madd_epi16(_mm_packs_epi32(a, b), _mm_set1_epi32(0x00012710));
}

HWY_INLINE __m128i groups_of_decimal(const char* at, const DecimalPlace& place) {
  const auto load = [](const void* from) {
    return _mm_loadu_si128(static_cast<const __m128i*>(from));
  };
  const __m128i bytes = load(at + place.end - 16);
  const __m128i digits = _mm_shuffle_epi8(bytes, load(without_point[place.part_count].data()));
  return groups_of_four(_mm_and_si128(digits, load(last_of_16.data() + place.digit_count)));
}

/// The doubles nearest to two numbers: the digits and the power of ten are exact doubles, so that
/// the division rounds once [Clinger 1990].
HWY_INLINE __m128d decimal_values(const char* at, const DecimalPlace& a, const DecimalPlace& b) {
  const __m128i eights = groups_of_eight(groups_of_decimal(at, a), groups_of_decimal(at, b));
  const __m128i digits = _mm_add_epi64(_mm_mul_epu32(eights, _mm_set1_epi64x(100'000'000)),
                                       _mm_srli_epi64(eights, 32));
  // 2^52 + x is the double whose last bits are x.
  const __m128d two_to_52 = _mm_set1_pd(0x1p52);
  const __m128d exact =
      _mm_sub_pd(_mm_castsi128_pd(_mm_or_si128(digits, _mm_castpd_si128(two_to_52))), two_to_52);
  const auto power_of = [](const DecimalPlace& place) {
    return &signed_powers_of_ten[place.is_negative][place.part_count];
  };
  return _mm_div_pd(exact, _mm_loadh_pd(_mm_load_sd(power_of(a)), power_of(b)));
}

/// Nonzero where a double lies in the middle of two floats, so that it does not tell which of them
/// is nearest to the number that it is nearest to itself.
HWY_INLINE int between_floats(__m128d values) {
  const __m128i below_float =
      _mm_and_si128(_mm_castpd_si128(values), _mm_set1_epi64x((1 << 29) - 1));
  return _mm_movemask_epi8(_mm_cmpeq_epi64(below_float, _mm_set1_epi64x(1 << 28)));
}

/// Eight digits or fewer, up to `end`.
struct IndexPlace {
  int end;
  int digit_count;
};

/// Not less than 8 where a run is empty or too long.
HWY_INLINE unsigned excess(const IndexPlace& place) {
  return static_cast<unsigned>(place.digit_count - 1);
}

/// 8 bytes from [i] on leave the values of the last i digits.
alignas(16) inline constexpr std::array<int8_t, 16> last_of_8{0,  0,  0,  0,  0,  0,  0,  0,
                                                              15, 15, 15, 15, 15, 15, 15, 15};

HWY_INLINE __m128i groups_of_indices(const char* at, const IndexPlace& a, const IndexPlace& b) {
  const auto load = [](const void* low, const void* high) {
    return _mm_unpacklo_epi64(_mm_loadl_epi64(static_cast<const __m128i*>(low)),
                              _mm_loadl_epi64(static_cast<const __m128i*>(high)));
  };
  const __m128i digits = load(at + a.end - 8, at + b.end - 8);
  return groups_of_four(_mm_and_si128(
      digits, load(last_of_8.data() + a.digit_count, last_of_8.data() + b.digit_count)));
}

/// The four values.
HWY_INLINE __m128i index_values(const char* at, const std::array<IndexPlace, 4>& places) {
  return groups_of_eight(groups_of_indices(at, places[0], places[1]),
                         groups_of_indices(at, places[2], places[3]));
}

HWY_INLINE bool has_zero(__m128i values) {
  return _mm_movemask_epi8(_mm_cmpeq_epi32(values, _mm_setzero_si128())) != 0;
}

}  // namespace HWY_NAMESPACE
}  // namespace tracer
HWY_AFTER_NAMESPACE();
#endif

#endif
