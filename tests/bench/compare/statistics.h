// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace bench {

struct Spread {
  double min = 0;
  double median = 0;
  double max = 0;
};

/// Of at least one value; the median of an even count is the mean of the middle two.
Spread spread_of(std::vector<double> values);

/// The least value that at least `part` (0 to 1) of all values do not exceed; at least one value.
double quantile(std::vector<double> values, double part);

/// The median of numerators[i] / denominators[i]: what was measured in the same round shares its
/// noise. At least one pair.
double paired_ratio(std::span<const double> numerators, std::span<const double> denominators);

/// Of positive values; 0 without any.
double geometric_mean(std::span<const double> values);

}  // namespace bench
