// SPDX-License-Identifier: MIT
#include "tests/support/bsdf_cases.h"

namespace tracer::test {
namespace {

struct Node {
  double place;
  double weight;
};

/// Gauss-Legendre on [0, 1].
std::vector<Node> gauss_nodes(int count) {
  std::vector<Node> nodes;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    double slope = 1;
    for (int step = 0; step < 20; ++step) {
      const double value = std::legendre(static_cast<unsigned>(count), x);
      const double before = std::legendre(static_cast<unsigned>(count - 1), x);
      slope = count * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    nodes.push_back({(1 - x) / 2, 1 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

}  // namespace

// Over the slopes r (cos, sin) of mirrors that send light towards wo: those that find it above the
// horizon fill a circle, and what is as wide as alpha is smooth in log r.
double integrate_above(const Vec3d& wo, double alpha, const OfDirection& f) {
  static const std::vector<Node> radial = gauss_nodes(80);
  static const std::vector<Node> angular = gauss_nodes(32);
  const double sine = std::sqrt(1 - wo.z * wo.z);
  const Vec2d towards = sine > 0 ? Vec2d(wo) / sine : Vec2d(1, 0);
  const double tangent = sine / wo.z;
  const double first = std::log(alpha * 1e-4);
  double sum = 0;
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (const Node& around : angular) {
      const double angle = (quarter + around.place) * std::numbers::pi / 2;
      const double along = std::cos(angle);
      const double reach = std::sqrt(tangent * tangent * along * along + 1);
      const double end =
          std::log(along > 0 ? reach + tangent * along : 1 / (reach - tangent * along));
      if (!(end > first)) continue;
      const Vec2d direction = along * towards + std::sin(angle) * Vec2d(-towards.y, towards.x);
      for (const Node& node : radial) {
        const double slope = std::exp(first + (end - first) * node.place);
        const Vec3d h = glm::normalize(Vec3d(slope * direction, 1));
        const double cosine = glm::dot(wo, h);
        const Vec3d wi = mirrored(wo, h);
        if (!(wi.z > 0 && cosine > 0)) continue;
        const double measure = 4 * cosine * h.z * h.z * h.z * slope * slope;
        sum += f(wi) * measure * (end - first) * node.weight * around.weight;
      }
    }
  }
  return sum * std::numbers::pi / 2;
}

double integrate_below(const OfDirection& f) {
  constexpr int rows = 400;
  constexpr int columns = 400;
  double sum = 0;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      sum += f(-direction_at((i + 0.5) / rows, (j + 0.5) / columns));
    }
  }
  return sum * 2 * std::numbers::pi / (rows * columns);
}

}  // namespace tracer::test
