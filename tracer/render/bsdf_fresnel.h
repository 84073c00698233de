// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace tracer {

/// Of unpolarised light that meets a boundary; eta: index beyond over index on this side.
inline double fresnel_dielectric(double cosine, double eta) {
  const double squared = eta * eta - 1 + cosine * cosine;
  if (squared <= 0) return 1;
  const double g = std::sqrt(squared);
  const double s = (g - cosine) / (g + cosine);
  const double p = (cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1);
  return 0.5 * s * s * (1 + p * p);
}

}  // namespace tracer
