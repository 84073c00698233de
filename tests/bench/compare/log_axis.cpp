// SPDX-License-Identifier: MIT
#include "tests/bench/compare/log_axis.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tests/bench/compare/svg.h"

namespace bench {
namespace {

using svg::Anchor;
using svg::line;
using svg::text;

constexpr const char* quiet = "#666666";
constexpr const char* grid = "stroke=\"#E4E4E4\"";

std::string superscript(int value) {
  constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  if (value < 0) return "⁻" + superscript(-value);
  return (value >= 10 ? superscript(value / 10) : "") + digits[value % 10];
}

}  // namespace

double LogScale::operator()(double value) const {
  const double part = std::log10(value / low) / std::log10(high / low);
  return at_low + (at_high - at_low) * part;
}

std::string decade(double value) {
  if (value > 0.0009 && value < 1001) return fmt::format("{:g}", value);
  return "10" + superscript(static_cast<int>(std::lround(std::log10(value))));
}

std::string y_axis(const Rectangle& plot, const LogScale& scale) {
  std::string drawn;
  const double decades = std::log10(scale.high / scale.low);
  const double step = std::pow(10, std::max(1.0, std::ceil(decades / 6)));
  for (double value = scale.low; value < scale.high * 1.01; value *= step) {
    drawn += line(plot.left, scale(value), plot.right, scale(value), grid);
    drawn += text(plot.left - 8, scale(value) + 4,
                  {.size = 12, .color = quiet, .anchor = Anchor::end}, decade(value));
  }
  return drawn;
}

std::string x_axis(const Rectangle& plot, const LogScale& scale) {
  std::string drawn;
  for (double power = 1e-3; power < 1e7; power *= 10) {
    for (const double digit : {1, 2, 5}) {
      const double value = digit * power;
      if (value < scale.low || value > scale.high) continue;
      drawn += line(scale(value), plot.top, scale(value), plot.bottom, grid);
      drawn +=
          text(scale(value), plot.bottom + 16,
               {.size = 12, .color = quiet, .anchor = Anchor::middle}, fmt::format("{:g}", value));
    }
  }
  return drawn;
}

}  // namespace bench
