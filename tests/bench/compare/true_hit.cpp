// SPDX-License-Identifier: MIT
#include "tests/bench/compare/true_hit.h"

#include <array>
#include <cfloat>
#include <cmath>

#include "tests/support/exact_hit.h"

namespace bench {
namespace {

using Real = long double;
using Vector = std::array<Real, 3>;

Vector vector_between(const tracer::Vec3f& from, const tracer::Vec3f& to) {
  return {Real{to.x} - from.x, Real{to.y} - from.y, Real{to.z} - from.z};
}

/// The value, within 16 epsilons of the sum of its terms' magnitudes: no term and no partial sum is
/// rounded more than seven times.
struct Sum {
  Real value = 0;
  Real magnitude = 0;

  void add(Real term) {
    value += term;
    magnitude += std::abs(term);
  }
  bool has_certain_sign() const { return std::abs(value) > 64 * LDBL_EPSILON * magnitude; }
  bool is_precise() const { return std::abs(value) > 0x1p44L * LDBL_EPSILON * magnitude; }
};

// a . (b x c)
Sum triple_product(const Vector& a, const Vector& b, const Vector& c) {
  Sum sum;
  for (size_t x = 0; x < 3; ++x) {
    const size_t y = (x + 1) % 3;
    const size_t z = (x + 2) % 3;
    sum.add(a[x] * b[y] * c[z]);
    sum.add(-a[x] * b[z] * c[y]);
  }
  return sum;
}

std::optional<Real> if_ahead(Real t) {
  if (t < 0) return std::nullopt;
  return t;
}

}  // namespace

std::optional<long double> true_hit(const tracer::Ray& ray, const tracer::Vec3f& v0,
                                    const tracer::Vec3f& v1, const tracer::Vec3f& v2) {
  const Vector direction = vector_between(tracer::Vec3f(0), ray.direction);
  const Vector a = vector_between(ray.origin, v0);
  const Vector b = vector_between(ray.origin, v1);
  const Vector c = vector_between(ray.origin, v2);
  const Sum u = triple_product(direction, c, b);
  const Sum v = triple_product(direction, a, c);
  const Sum w = triple_product(direction, b, a);
  if (u.has_certain_sign() && v.has_certain_sign() && w.has_certain_sign()) {
    if ((u.value < 0) != (v.value < 0) || (v.value < 0) != (w.value < 0)) return std::nullopt;
    const Vector edge1 = vector_between(v0, v1);
    const Vector edge2 = vector_between(v0, v2);
    const Sum numerator = triple_product(a, edge2, edge1);
    const Sum determinant = triple_product(direction, edge2, edge1);
    if (numerator.is_precise() && determinant.is_precise()) {
      return if_ahead(numerator.value / determinant.value);
    }
  }
  const tracer::ExactHit exact = tracer::exact_hit(ray, v0, v1, v2);
  return exact.is_hit ? if_ahead(exact.t) : std::nullopt;
}

}  // namespace bench
