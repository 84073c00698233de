// SPDX-License-Identifier: MIT
// An oracle that shares nothing with the code it judges: plain long arithmetic on integers.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "tracer/base/vectors.h"

namespace tracer {

/// Two's complement, 1024 bits: room for products of three differences of floats in 2^-149.
class ExactInteger {
 public:
  ExactInteger() = default;
  /// value * 2^149, an integer for every finite float.
  explicit ExactInteger(float value) {
    int exponent = 0;
    const double mantissa = std::frexp(std::abs(static_cast<double>(value)), &exponent) * 0x1p24;
    auto bits = static_cast<uint64_t>(mantissa);
    int shift = exponent - 24 + 149;
    if (shift < 0) bits >>= -shift, shift = 0;
    words_[shift / 32] = static_cast<uint32_t>(bits << (shift % 32));
    words_[shift / 32 + 1] = static_cast<uint32_t>((bits << (shift % 32)) >> 32);
    if (value < 0) *this = ExactInteger() - *this;
  }

  ExactInteger operator-(const ExactInteger& other) const {
    ExactInteger difference;
    int64_t borrow = 0;
    for (size_t i = 0; i < words; ++i) {
      const int64_t word = int64_t{words_[i]} - int64_t{other.words_[i]} - borrow;
      difference.words_[i] = static_cast<uint32_t>(word);
      borrow = word < 0;
    }
    return difference;
  }
  ExactInteger operator+(const ExactInteger& other) const {
    return *this - (ExactInteger() - other);
  }
  // Modulo 2^1024, where two's complement multiplies like natural numbers.
  ExactInteger operator*(const ExactInteger& other) const {
    ExactInteger product;
    for (size_t i = 0; i < words; ++i) {
      uint64_t carry = 0;
      for (size_t j = 0; i + j < words; ++j) {
        carry += uint64_t{words_[i]} * other.words_[j] + product.words_[i + j];
        product.words_[i + j] = static_cast<uint32_t>(carry);
        carry >>= 32;
      }
    }
    return product;
  }

  int sign() const {
    if (words_[words - 1] >> 31) return -1;
    for (const uint32_t word : words_) {
      if (word != 0) return 1;
    }
    return 0;
  }
  /// Good to 90 bits; scaled by 2^-900 so that it stays in range.
  long double scaled_value() const {
    if (sign() < 0) return -(ExactInteger() - *this).scaled_value();
    long double value = 0;
    for (size_t i = 0; i < words; ++i) {
      value += std::ldexp(static_cast<long double>(words_[i]), static_cast<int>(32 * i) - 900);
    }
    return value;
  }

 private:
  static constexpr size_t words = 32;
  std::array<uint32_t, words> words_{};
};

using ExactVec3 = std::array<ExactInteger, 3>;

inline ExactVec3 exact_vec3(const Vec3f& from, const Vec3f& to) {
  return {ExactInteger(to.x) - ExactInteger(from.x), ExactInteger(to.y) - ExactInteger(from.y),
          ExactInteger(to.z) - ExactInteger(from.z)};
}

/// a . (b x c)
inline ExactInteger exact_triple(const ExactVec3& a, const ExactVec3& b, const ExactVec3& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

}  // namespace tracer
