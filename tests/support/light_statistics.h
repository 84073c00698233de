// SPDX-License-Identifier: MIT
// Counts against what they should be, and points that fill cubes evenly.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace tracer::test {

/// How far counts are from `expected`, in standard deviations of a chi-square; cells that expect
/// fewer than ten are taken together.
inline double chi_square_deviation(const std::vector<double>& counts,
                                   const std::vector<double>& expected) {
  constexpr double least = 10;
  double sum = 0, rest_count = 0, rest_expected = 0;
  int cells = 0;
  const auto add = [&](double count, double wanted) {
    sum += (count - wanted) * (count - wanted) / wanted;
    ++cells;
  };
  for (size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] >= least) {
      add(counts[i], expected[i]);
    } else {
      rest_count += counts[i];
      rest_expected += expected[i];
    }
  }
  if (rest_expected > 0) add(rest_count, rest_expected);
  if (rest_expected <= 0 && rest_count > 0) return std::numeric_limits<double>::infinity();
  const double degrees = cells - 1;
  return degrees > 0 ? (sum - degrees) / std::sqrt(2 * degrees) : 0;
}

/// The point `index` of a sequence that fills the cube evenly: multiples of irrational numbers.
template <size_t dimensions>
std::array<double, dimensions> even_point(uint64_t index) {
  // One over the powers of the root of x^(d+1) = x + 1.
  static const std::array<double, dimensions> steps = [] {
    double root = 1.5;
    for (int i = 0; i < 60; ++i) root = std::pow(1 + root, 1.0 / (dimensions + 1));
    std::array<double, dimensions> powers;
    double step = 1;
    for (double& power : powers) power = step /= root;
    return powers;
  }();
  std::array<double, dimensions> point;
  for (size_t i = 0; i < dimensions; ++i) {
    const double place = 0.5 + static_cast<double>(index) * steps[i];
    point[i] = place - std::floor(place);
  }
  return point;
}

}  // namespace tracer::test
