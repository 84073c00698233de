// SPDX-License-Identifier: MIT
// How far a picture is from a reference.
#pragma once

#include "tests/bench/compare/error_runs.h"

namespace bench {

struct ErrorMeasures {
  double relmse = 0;  // mean of (x - r)^2 / (r^2 + 0.01)
  double rmse = 0;
  double mae = 0;
  double flip = 0;  // mean of the pictures as they are seen: flip.h
};

/// Squares are (x - A)(x - B), A and B the reference's halves: without the bias that the
/// reference's own noise would add. Of equal sizes.
ErrorMeasures measure_errors(const tracer::Image& picture, const Reference& reference);

/// relMSE of the mean of the reference's halves against what they converge to.
double reference_relmse(const Reference& reference);

/// Mean of (x - A)(y - B) / (r^2 + 0.01) of two pictures that share no samples: how far what they
/// converge to is from what the reference converges to. Near 0, of either sign, where that is the
/// same.
double systematic_relmse(const tracer::Image& x, const tracer::Image& y,
                         const Reference& reference);

}  // namespace bench
