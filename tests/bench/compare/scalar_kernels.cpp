// SPDX-License-Identifier: MIT
// Ray-triangle tests one triangle at a time, from the papers.
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <memory>
#include <optional>

#include "tests/bench/compare/kernels.h"
#include "tracer/geometry/triangle.h"

namespace bench {
namespace {

using tracer::Ray;
using tracer::Vec3d;
using tracer::Vec3f;

struct Corners {
  Vec3f v0, v1, v2;
};

bool counts(const Ray& ray, double t) {
  return t >= ray.t_min && t <= ray.t_max;
}

/// [Moeller 1997], without its epsilon: any determinant but 0 will do.
template <class Vector>
struct MoellerTrumbore {
  explicit MoellerTrumbore(const Ray& given) : ray(given) {}

  std::optional<double> operator()(const Corners& corners) const {
    using Real = typename Vector::value_type;
    const Vector direction(ray.direction);
    const Vector v0(corners.v0);
    const Vector edge1 = Vector(corners.v1) - v0;
    const Vector edge2 = Vector(corners.v2) - v0;
    const Vector p = glm::cross(direction, edge2);
    const Real determinant = glm::dot(edge1, p);
    if (determinant == 0) return std::nullopt;
    const Real inverse = 1 / determinant;
    const Vector from_v0 = Vector(ray.origin) - v0;
    const Real weight1 = glm::dot(from_v0, p) * inverse;
    if (!(weight1 >= 0 && weight1 <= 1)) return std::nullopt;
    const Vector q = glm::cross(from_v0, edge1);
    const Real weight2 = glm::dot(direction, q) * inverse;
    if (!(weight2 >= 0 && weight1 + weight2 <= 1)) return std::nullopt;
    const Real t = glm::dot(edge2, q) * inverse;
    if (!counts(ray, double{t})) return std::nullopt;
    return double{t};
  }

  const Ray& ray;
};

/// The watertight test [Woop 2013] without culling: sheared coordinates that triangles share, and
/// double where an edge function is zero.
struct Woop {
  explicit Woop(const Ray& given) : ray(given) {
    const Vec3f size = glm::abs(ray.direction);
    z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    x = (z + 1) % 3;
    y = (x + 1) % 3;
    if (ray.direction[z] < 0) std::swap(x, y);
    shear = Vec3f(ray.direction[x], ray.direction[y], 1) / ray.direction[z];
  }

  std::optional<double> operator()(const Corners& corners) const {
    const Vec3f a = sheared(corners.v0), b = sheared(corners.v1), c = sheared(corners.v2);
    float u = c.x * b.y - c.y * b.x;
    float v = a.x * c.y - a.y * c.x;
    float w = b.x * a.y - b.y * a.x;
    if (u == 0 || v == 0 || w == 0) {
      u = edge_in_double(c, b), v = edge_in_double(a, c), w = edge_in_double(b, a);
    }
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return std::nullopt;
    const float determinant = u + v + w;
    if (determinant == 0) return std::nullopt;
    const float t = (u * a.z + v * b.z + w * c.z) / determinant;
    if (!counts(ray, double{t})) return std::nullopt;
    return double{t};
  }

  Vec3f sheared(const Vec3f& vertex) const {
    const Vec3f from_origin = vertex - ray.origin;
    return {from_origin[x] - shear.x * from_origin[z], from_origin[y] - shear.y * from_origin[z],
            shear.z * from_origin[z]};
  }
  static float edge_in_double(const Vec3f& a, const Vec3f& b) {
    return static_cast<float>(double{a.x} * b.y - double{a.y} * b.x);
  }

  const Ray& ray;
  int x, y, z;
  Vec3f shear;
};

/// Sides of the edges as Pluecker lines [Shoemake 1998], with a tolerance relative to their sum as
/// Embree's robust mode has it.
struct Pluecker {
  explicit Pluecker(const Ray& given) : ray(given) {}

  std::optional<double> operator()(const Corners& corners) const {
    const Vec3f a = corners.v0 - ray.origin;
    const Vec3f b = corners.v1 - ray.origin;
    const Vec3f c = corners.v2 - ray.origin;
    const Vec3f edge_ca = c - a, edge_ab = a - b, edge_bc = b - c;
    const float u = glm::dot(glm::cross(edge_ca, c + a), ray.direction);
    const float v = glm::dot(glm::cross(edge_ab, a + b), ray.direction);
    const float w = glm::dot(glm::cross(edge_bc, b + c), ray.direction);
    const float tolerance = FLT_EPSILON * std::abs(u + v + w);
    if (std::min({u, v, w}) < -tolerance && std::max({u, v, w}) > tolerance) return std::nullopt;
    const Vec3f normal = stable_normal(edge_ca, edge_ab, edge_bc);
    const float determinant = glm::dot(normal, ray.direction);
    if (determinant == 0) return std::nullopt;
    const float t = glm::dot(a, normal) / determinant;
    if (!counts(ray, double{t})) return std::nullopt;
    return double{t};
  }

  // Each component from the two edges whose products cancel less.
  static Vec3f stable_normal(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    Vec3f normal;
    for (int x = 0; x < 3; ++x) {
      const int y = (x + 1) % 3, z = (x + 2) % 3;
      const float ab = a[z] * b[y], bc = b[z] * c[y];
      normal[x] = std::abs(ab) < std::abs(bc) ? a[y] * b[z] - ab : b[y] * c[z] - bc;
    }
    return normal;
  }

  const Ray& ray;
};

struct Exact {
  explicit Exact(const Ray& given) : ray(given) {}

  std::optional<double> operator()(const Corners& corners) const {
    const auto hit = intersect_triangle(ray, corners.v0, corners.v1, corners.v2);
    if (!hit) return std::nullopt;
    return hit->t;
  }

  const Ray& ray;
};

template <class Test>
TestRays prepare(const KernelBlock& block, std::span<const Ray> rays) {
  auto tests = std::make_shared<std::vector<Test>>(rays.begin(), rays.end());
  auto triangles = std::make_shared<std::vector<Corners>>();
  for (uint32_t i = 0; i < block.triangle_count(); ++i) {
    triangles->push_back({block.corner(i, 0), block.corner(i, 1), block.corner(i, 2)});
  }
  return [tests, triangles](std::span<Found> found) {
    for (size_t i = 0; i < tests->size(); ++i) {
      const Test& test = (*tests)[i];
      found[i].hits = 0;
      for (size_t k = 0; k < triangles->size(); ++k) {
        const auto t = test((*triangles)[k]);
        if (!t) continue;
        found[i].hits |= 1u << k;
        found[i].t[k] = *t;
      }
    }
  };
}

template <class Test>
constexpr Kernel scalar(std::string_view name) {
  return {name, Form::scalar, prepare<Test>, prepare<Test>};
}

constexpr Kernel table[] = {
    scalar<MoellerTrumbore<Vec3f>>("Möller-Trumbore"),
    scalar<Woop>("Woop 2013"),
    scalar<Pluecker>("Plücker"),
    scalar<MoellerTrumbore<Vec3d>>("Möller-Trumbore in double"),
    scalar<Exact>("Boxwood"),
};

}  // namespace

std::span<const Kernel> scalar_kernels() {
  return table;
}

}  // namespace bench
