// SPDX-License-Identifier: MIT
// Nodes of integrals and places in tables, for what is tabulated of rough surfaces.
#pragma once

#include <array>
#include <cstddef>

#include "tracer/base/trigonometry.h"
#include "tracer/render/bsdf_ggx.h"

namespace tracer {

/// Of an integral over (0, 1).
struct QuadratureNode {
  double place = 0;  // in (0, 1)
  double weight = 0;
};

/// Gauss-Legendre nodes on [0, 1], by Newton's method on the polynomial's recurrence.
template <int count>
std::array<QuadratureNode, count> make_gauss_nodes() {
  std::array<QuadratureNode, count> nodes;
  for (int i = 0; i < count; ++i) {
    double x = cos_sin_of_turns((i + 0.75) / (count + 0.5) / 2).cos;
    double slope = 1;
    for (int step = 0; step < 10; ++step) {
      double before = 1;
      double value = x;
      for (int degree = 2; degree <= count; ++degree) {
        const double next = ((2 * degree - 1) * x * value - (degree - 1) * before) / degree;
        before = value;
        value = next;
      }
      slope = count * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    nodes[static_cast<size_t>(i)] = {(1 - x) / 2, 1 / ((1 - x * x) * slope * slope)};
  }
  return nodes;
}

/// Chebyshev's places on [0, 1], ends included, and the weights of what is known there at `place`.
template <size_t count>
std::array<double, count> make_chebyshev_places() {
  std::array<double, count> places;
  for (size_t i = 0; i < count; ++i) {
    places[i] = (1 - cos_sin_of_turns(static_cast<double>(i) / (count - 1) / 2).cos) / 2;
  }
  return places;
}
template <size_t count>
std::array<double, count> chebyshev_weights(const std::array<double, count>& places, double place) {
  std::array<double, count> weights{};
  double sum = 0;
  for (size_t i = 0; i < count; ++i) {
    if (place == places[i]) {
      weights = {};
      weights[i] = 1;
      return weights;
    }
    const double end = i == 0 || i == count - 1 ? 0.5 : 1;
    weights[i] = (i % 2 == 0 ? end : -end) / (place - places[i]);
    sum += weights[i];
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

struct LinearTaps {
  size_t first = 0;
  double next_weight = 0;
};
inline LinearTaps make_linear_taps(double place, size_t count) {
  const double x = std::clamp(place, 0.0, 1.0) * static_cast<double>(count - 1);
  const size_t first = std::min(static_cast<size_t>(x), count - 2);
  return {first, x - static_cast<double>(first)};
}
inline double place_of(size_t i, size_t count) {
  return static_cast<double>(i) / static_cast<double>(count - 1);
}

/// The cubic through four neighbours.
struct CubicTaps {
  size_t first = 0;
  std::array<double, 4> weights{1, 0, 0, 0};
};
inline CubicTaps make_cubic_taps(double place, size_t count) {
  const double x = std::clamp(place, 0.0, 1.0) * static_cast<double>(count - 1);
  const size_t first = std::clamp<size_t>(static_cast<size_t>(x), 1, count - 3) - 1;
  const double f = x - static_cast<double>(first);
  return {first,
          {-(f - 1) * (f - 2) * (f - 3) / 6, f * (f - 2) * (f - 3) / 2, -f * (f - 1) * (f - 3) / 2,
           f * (f - 1) * (f - 2) / 6}};
}

inline constexpr double least_roughness = 0x1p-7;
static_assert(least_roughness * least_roughness == smoothest_alpha);

// Tables are denser where surfaces are smooth.
inline double place_of_alpha(double alpha) {
  const double place = (std::sqrt(alpha) - least_roughness) / (1 - least_roughness);
  return std::sqrt(std::max(0.0, place));
}
inline double alpha_of_place(double place) {
  const double roughness = least_roughness + (1 - least_roughness) * place * place;
  return roughness * roughness;
}

// A third of the places is spent on cosines about alpha, where facets hide most.
inline double place_of_cosine(double cosine, double alpha) {
  return 0.35 * cosine * (1 + 4 * alpha) / (cosine + 4 * alpha) + 0.65 * std::sqrt(cosine);
}
inline double cosine_of_place(double place, double alpha) {
  double low = 0;
  double high = 1;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = (low + high) / 2;
    (place_of_cosine(middle, alpha) < place ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace tracer
