// SPDX-License-Identifier: MIT
#include "tracer/geometry/triangle.h"

#include "tracer/geometry/expansion.h"
#include "tracer/geometry/triangle-inl.h"

namespace tracer {
namespace exact_triangle {
namespace {

using ExactVector = std::array<Expansion<2>, 3>;

ExactVector exact_vector(const Vec3f& from, const Vec3f& to) {
  return {exact_difference(to.x, from.x), exact_difference(to.y, from.y),
          exact_difference(to.z, from.z)};
}

// a . (b x c)
double exact_triple_product(const ExactVector& a, const ExactVector& b, const ExactVector& c) {
  Expansion<192> sum;
  for (int x = 0; x < 3; ++x) {
    const int y = (x + 1) % 3;
    const int z = (x + 2) % 3;
    Expansion<16> cross;
    cross.add(exact_product(b[y], c[z]));
    cross.subtract(exact_product(b[z], c[y]));
    sum.add(exact_product(cross, a[x]));
  }
  return sum.estimate();
}

}  // namespace

Weights exact_weights(const Ray& ray, const Vec3f& v0, const Vec3f& v1, const Vec3f& v2) {
  const ExactVector direction = exact_vector(Vec3f(0), ray.direction);
  const ExactVector a = exact_vector(ray.origin, v0);
  const ExactVector b = exact_vector(ray.origin, v1);
  const ExactVector c = exact_vector(ray.origin, v2);
  return {exact_triple_product(direction, c, b), exact_triple_product(direction, a, c),
          exact_triple_product(direction, b, a)};
}

Quotient exact_distance(const Ray& ray, const Vec3f& v0, const Vec3f& v1, const Vec3f& v2) {
  const ExactVector edge1 = exact_vector(v0, v1);
  const ExactVector edge2 = exact_vector(v0, v2);
  return {exact_triple_product(exact_vector(ray.origin, v0), edge2, edge1),
          exact_triple_product(exact_vector(Vec3f(0), ray.direction), edge2, edge1)};
}

}  // namespace exact_triangle

std::optional<TriangleHit> intersect_triangle(const Ray& ray, const Vec3f& v0, const Vec3f& v1,
                                              const Vec3f& v2) noexcept {
  return exact_triangle::intersect(ray, v0, v1, v2);
}

}  // namespace tracer
