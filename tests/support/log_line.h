// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <span>

namespace tests {

/// log(y) = offset + slope log(x), natural logarithms.
struct LogLine {
  double offset = 0, slope = 0;
  double x_of(double y) const { return std::exp((std::log(y) - offset) / slope); }
};

struct LogPoint {
  double x, y;
};

/// Least squares through the logarithms of the points that are positive; slope 0 for one x.
inline LogLine fit_log_line(std::span<const LogPoint> points) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const LogPoint& point : points) {
    if (!(point.x > 0) || !(point.y > 0)) continue;
    const double x = std::log(point.x), y = std::log(point.y);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double spread = n * sxx - sx * sx;
  const double slope = spread > 0 ? (n * sxy - sx * sy) / spread : 0;
  return {n > 0 ? (sy - slope * sx) / n : 0, slope};
}

}  // namespace tests
