// SPDX-License-Identifier: MIT
// Logarithmic axes of charts in SVG.
#pragma once

#include <string>

#include "tests/bench/compare/place_labels.h"

namespace bench {

/// Powers of ten and what lies between them, onto pixels.
struct LogScale {
  double low, high;        // of the values
  double at_low, at_high;  // in pixels

  double operator()(double value) const;
};

/// "0.01", "100"; "10⁻⁶" where that is shorter.
std::string decade(double value);

/// Lines across `plot` with their values at its left; no more than some six.
std::string y_axis(const Rectangle& plot, const LogScale& scale);
/// Lines up `plot` at 1, 2 and 5 times a power of ten with their values below it.
std::string x_axis(const Rectangle& plot, const LogScale& scale);

}  // namespace bench
