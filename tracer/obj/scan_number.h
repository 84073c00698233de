// SPDX-License-Identifier: MIT
// Numbers as exporters write them, eight digits at a time. Each function reads up to 48 bytes from
// where it begins, and gives up where a number is of a rarer form: then parse_number.h reads it.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace tracer {

/// The eight bytes at `at`, the first one lowest, each digit as its value; other bytes are 10 or
/// more.
inline uint64_t load_digits(const char* at) {
  uint64_t bytes;
  std::memcpy(&bytes, at, sizeof bytes);
  if constexpr (std::endian::native == std::endian::big) bytes = __builtin_bswap64(bytes);
  return bytes ^ 0x3030303030303030u;
}

/// How many of the eight are digits before the first that is none.
inline int count_digits(uint64_t digits) {
  // Sets the top bit of bytes of 10 and more; what is carried over only reaches those behind one.
  const uint64_t others = ((digits + 0x7676767676767676u) | digits) & 0x8080808080808080u;
  return std::countr_zero(others) / 8;
}

/// The number that the first `count` > 0 digits of eight make.
inline uint32_t digits_value(uint64_t digits, int count) {
  digits <<= 8 * (8 - count);  // zeros in front
  digits = (digits * 10 + (digits >> 8)) & 0x00ff00ff00ff00ffu;
  digits = (digits * 100 + (digits >> 16)) & 0x0000ffff0000ffffu;
  return static_cast<uint32_t>(digits * 10000 + (digits >> 32));
}

/// Moves `at` past an index, a sign and one to eight digits; its value, or 0 where there is none,
/// or more digits.
inline int32_t scan_index(const char*& at) {
  const bool is_negative = *at == '-';
  at += is_negative;
  const uint64_t digits = load_digits(at);
  const int count = count_digits(digits);
  if (count == 0) return 0;
  at += count;
  if (count == 8 && static_cast<unsigned char>(*at - '0') < 10) return 0;
  const auto value = static_cast<int32_t>(digits_value(digits, count));
  return is_negative ? -value : value;
}

/// Bit i tells whether byte i of the 32 at `at` is no digit.
inline uint32_t other_bytes(const char* at) {
#ifdef __SSE2__
  const auto digits_of_16 = [](const char* from) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
    const __m128i values = _mm_sub_epi8(bytes, _mm_set1_epi8('0'));
    const __m128i is_digit = _mm_cmpeq_epi8(_mm_min_epu8(values, _mm_set1_epi8(9)), values);
    return static_cast<uint32_t>(_mm_movemask_epi8(is_digit));
  };
  return ~(digits_of_16(at) | digits_of_16(at + 16) << 16);
#else
  uint32_t others = 0;
  for (int i = 0; i < 32; ++i) {
    others |= uint32_t{static_cast<unsigned char>(at[i] - '0') > 9} << i;
  }
  return others;
#endif
}

/// Where a run of one to eight digits stands; others count as none.
struct DigitRun {
  const char* begin;
  int count;

  bool is_usable() const { return static_cast<unsigned>(count - 1) < 8; }
  /// Of a usable run.
  uint32_t value() const { return digits_value(load_digits(begin), count); }
};

/// Goes from run to run of digits with one byte between each and the next, within 32 bytes.
class DigitRuns {
 public:
  explicit DigitRuns(const char* at) : at_(at), others_(other_bytes(at)) {}

  /// The run behind the last, and the byte after it, which end() is.
  DigitRun next() {
    const int begin = end_ + 1;
    end_ = std::countr_zero(others_);
    others_ &= others_ - 1;
    return {at_ + begin, end_ - begin};
  }
  const char* end() const { return at_ + end_; }

 private:
  const char* at_;
  uint32_t others_;
  int end_ = -1;
};

namespace scan_detail {

constexpr int largest_exact_power = 22;
inline constexpr double powers_of_ten[largest_exact_power + 1] = {
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
inline constexpr uint64_t whole_powers_of_ten[9] = {
    1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000};

}  // namespace scan_detail

/// scan_double for the form that nearly all numbers have, digits on both sides of a point: each
/// step waits for few others.
inline bool scan_plain_double(const char*& at, double& value) {
  const bool is_negative = *at == '-';
  DigitRuns runs(at + is_negative);
  const DigitRun whole = runs.next();
  const char* const point = runs.end();
  const DigitRun part = runs.next();
  const bool is_plain = *point == '.' && static_cast<unsigned char>(*runs.end()) <= ' ';
  if (!is_plain || !whole.is_usable() || !part.is_usable() || whole.count + part.count > 15) {
    return false;
  }
  const uint64_t mantissa =
      whole.value() * scan_detail::whole_powers_of_ten[part.count] + part.value();
  const double magnitude =
      static_cast<double>(static_cast<int64_t>(mantissa)) / scan_detail::powers_of_ten[part.count];
  // Half of all numbers have a sign, and no branch foresees which.
  value = std::bit_cast<double>(std::bit_cast<uint64_t>(magnitude) | uint64_t{is_negative} << 63);
  at = runs.end();
  return true;
}

/// scan_double for all other forms that it reads.
bool scan_rare_double(const char*& at, double& value);

/// Moves `at` past a number of at most 15 digits, and gives the double nearest to it; false where
/// the number is of another form. Mantissa and power of ten are exact doubles, so that the one
/// operation between them rounds once [Clinger 1990].
inline bool scan_double(const char*& at, double& value) {
  return scan_plain_double(at, value) || scan_rare_double(at, value);
}

/// The float nearest to a number that the double `nearest` is nearest to; false where the double
/// does not tell: at the middle of two floats, and where floats are denormal.
inline bool round_to_float(double nearest, float& value) {
  constexpr uint64_t below_float = (uint64_t{1} << 29) - 1;
  constexpr uint64_t middle = uint64_t{1} << 28;
  constexpr double smallest_normal = 0x1p-126;
  if ((std::bit_cast<uint64_t>(nearest) & below_float) == middle) return false;
  if (nearest != 0 && nearest < smallest_normal && nearest > -smallest_normal) return false;
  value = static_cast<float>(nearest);
  return true;
}

}  // namespace tracer
