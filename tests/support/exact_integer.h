// SPDX-License-Identifier: MIT
// An oracle that shares nothing with the code it judges: plain long arithmetic on integers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "tracer/base/vectors.h"

namespace tracer {

/// An integer of at most 1152 bits times a power of two: every finite float is one, and there is
/// room for sums of products of three differences of any floats. All operations are exact.
class ExactInteger {
 public:
  ExactInteger() = default;
  /// value is finite.
  explicit ExactInteger(float value) {
    if (value == 0) return;
    int exponent = 0;
    const double mantissa = std::frexp(std::abs(static_cast<double>(value)), &exponent);
    words_[0] = static_cast<uint64_t>(mantissa * 0x1p24);
    size_ = 1;
    exponent_ = exponent - 24;
    is_negative_ = value < 0;
  }

  ExactInteger operator-() const {
    ExactInteger negated = *this;
    negated.is_negative_ = !is_negative_;
    return negated;
  }
  ExactInteger operator+(const ExactInteger& other) const {
    if (exponent_ > other.exponent_ && size_ > 0)
      return shifted(exponent_ - other.exponent_) + other;
    if (exponent_ < other.exponent_ && other.size_ > 0) {
      return *this + other.shifted(other.exponent_ - exponent_);
    }
    if (other.size_ == 0) return *this;
    if (size_ == 0) return other;
    if (is_negative_ == other.is_negative_) return sum(*this, other);
    return is_magnitude_less(other) ? difference(other, *this) : difference(*this, other);
  }
  ExactInteger operator-(const ExactInteger& other) const { return *this + -other; }
  ExactInteger operator*(const ExactInteger& other) const {
    ExactInteger product;
    if (size_ == 0 || other.size_ == 0) return product;
    product.exponent_ = exponent_ + other.exponent_;
    product.is_negative_ = is_negative_ != other.is_negative_;
    product.size_ = size_ + other.size_;
    for (int i = 0; i < size_; ++i) {
      Wide carry = 0;
      for (int j = 0; j < other.size_; ++j) {
        carry += static_cast<Wide>(word(i)) * other.word(j) + product.word(i + j);
        product.word(i + j) = static_cast<uint64_t>(carry);
        carry >>= 64;
      }
      product.word(i + other.size_) = static_cast<uint64_t>(carry);
    }
    product.drop_leading_zeros();
    return product;
  }

  int sign() const { return size_ == 0 ? 0 : is_negative_ ? -1 : 1; }
  /// Good to 63 bits; up to a power of two that is the same for all values.
  long double scaled_value() const {
    long double value = 0;
    for (int i = std::max(0, size_ - 3); i < size_; ++i) {
      value += std::ldexp(static_cast<long double>(word(i)), 64 * i + exponent_);
    }
    return is_negative_ ? -value : value;
  }

 private:
  __extension__ using Wide = unsigned __int128;
  static constexpr size_t capacity = 18;

  uint64_t& word(int i) { return words_[static_cast<size_t>(i)]; }
  uint64_t word(int i) const { return words_[static_cast<size_t>(i)]; }
  uint64_t word_or_zero(int i) const { return i >= 0 && i < size_ ? word(i) : 0; }
  void drop_leading_zeros() {
    while (size_ > 0 && word(size_ - 1) == 0) --size_;
  }

  /// The same value, its exponent lower by `bits`.
  ExactInteger shifted(int bits) const {
    ExactInteger result;
    result.exponent_ = exponent_ - bits;
    result.is_negative_ = is_negative_;
    result.size_ = size_ + bits / 64 + 1;
    const int rest = bits % 64;
    for (int i = bits / 64; i < result.size_; ++i) {
      const int from = i - bits / 64;
      const uint64_t low = rest == 0 ? 0 : word_or_zero(from - 1) >> (64 - rest);
      result.words_.at(static_cast<size_t>(i)) = word_or_zero(from) << rest | low;
    }
    result.drop_leading_zeros();
    return result;
  }

  // Of equal exponents.
  bool is_magnitude_less(const ExactInteger& other) const {
    if (size_ != other.size_) return size_ < other.size_;
    for (int i = size_ - 1; i >= 0; --i) {
      if (word(i) != other.word(i)) return word(i) < other.word(i);
    }
    return false;
  }
  static ExactInteger sum(const ExactInteger& a, const ExactInteger& b) {
    ExactInteger result;
    result.exponent_ = a.exponent_;
    result.is_negative_ = a.is_negative_;
    result.size_ = std::max(a.size_, b.size_) + 1;
    Wide carry = 0;
    for (int i = 0; i < result.size_; ++i) {
      carry += static_cast<Wide>(a.word_or_zero(i)) + b.word_or_zero(i);
      result.words_.at(static_cast<size_t>(i)) = static_cast<uint64_t>(carry);
      carry >>= 64;
    }
    result.drop_leading_zeros();
    return result;
  }
  /// |larger| - |smaller|, of larger's sign.
  static ExactInteger difference(const ExactInteger& larger, const ExactInteger& smaller) {
    ExactInteger result = larger;
    uint64_t borrow = 0;
    for (int i = 0; i < larger.size_; ++i) {
      const Wide taken = static_cast<Wide>(smaller.word_or_zero(i)) + borrow;
      borrow = taken > larger.word(i);
      result.word(i) = larger.word(i) - static_cast<uint64_t>(taken);
    }
    result.drop_leading_zeros();
    return result;
  }

  std::array<uint64_t, capacity> words_{};  // least first; the last of `size_` is not zero
  int size_ = 0;
  int exponent_ = 0;
  bool is_negative_ = false;
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
