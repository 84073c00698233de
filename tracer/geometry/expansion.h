// SPDX-License-Identifier: MIT
// Exact arithmetic on sums of doubles [Shewchuk 1997], rounding to nearest, ties to even. Exact as
// long as no operation overflows or underflows: the caller knows its exponents.
#pragma once

#include <array>

namespace tracer {

/// value + error, exactly the result of the operation that made it; value is the rounded result.
struct RoundedDouble {
  double value;
  double error;
};

inline RoundedDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

/// [Dekker 1971]: two halves of 26 bits, so that their products are exact without an FMA.
inline RoundedDouble split_in_halves(double a) {
  const double shifted = 0x1.0000002p27 * a;  // 2^27 + 1
  const double high = shifted - (shifted - a);
  return {high, a - high};
}

inline RoundedDouble two_product(double a, double b) {
  const double product = a * b;
  const auto [a_high, a_low] = split_in_halves(a);
  const auto [b_high, b_low] = split_in_halves(b);
  const double missing = ((product - a_high * b_high) - a_low * b_high) - a_high * b_low;
  return {product, a_low * b_low - missing};
}

/// The exact sum of at most `capacity` doubles: nonzero, nonadjacent, in order of magnitude. No
/// terms: zero. Only `add` changes it, which keeps that so ([Shewchuk 1997] theorem 10).
template <int capacity>
class Expansion {
 public:
  void add(double b) {
    double carry = b;
    int kept = 0;
    for (int i = 0; i < size_; ++i) {
      const auto [value, error] = two_sum(carry, terms_[i]);
      carry = value;
      if (error != 0) terms_[kept++] = error;
    }
    if (carry != 0) terms_[kept++] = carry;
    size_ = kept;
  }
  template <int other_capacity>
  void add(const Expansion<other_capacity>& other) {
    for (int i = 0; i < other.size(); ++i) add(other[i]);
  }
  template <int other_capacity>
  void subtract(const Expansion<other_capacity>& other) {
    for (int i = 0; i < other.size(); ++i) add(-other[i]);
  }

  int size() const { return size_; }
  double operator[](int term) const { return terms_[term]; }

  /// -1, 0 or 1: the largest term outweighs all others.
  int sign() const { return size_ == 0 ? 0 : terms_[size_ - 1] > 0 ? 1 : -1; }
  /// Within 8 * 2^-53 of the value, relatively: each partial sum is at most twice its last term,
  /// terms at least halve, and the value is at least half the largest.
  double estimate() const {
    double sum = 0;
    for (int i = 0; i < size_; ++i) sum += terms_[i];
    return sum;
  }

 private:
  std::array<double, capacity> terms_;  // [0, size_) is set
  int size_ = 0;
};

/// a - b.
inline Expansion<2> exact_difference(double a, double b) {
  Expansion<2> difference;
  const auto [value, error] = two_sum(a, -b);
  difference.add(error);
  difference.add(value);
  return difference;
}

template <int a_capacity, int b_capacity>
Expansion<2 * a_capacity * b_capacity> exact_product(const Expansion<a_capacity>& a,
                                                     const Expansion<b_capacity>& b) {
  Expansion<2 * a_capacity * b_capacity> product;
  for (int i = 0; i < a.size(); ++i) {
    for (int j = 0; j < b.size(); ++j) {
      const auto [value, error] = two_product(a[i], b[j]);
      product.add(error);
      product.add(value);
    }
  }
  return product;
}

}  // namespace tracer
