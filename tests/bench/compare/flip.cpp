// SPDX-License-Identifier: MIT
// [Andersson 2020], section and equation numbers below are its own.
#include "tests/bench/compare/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "tracer/base/parallel.h"

namespace bench {
namespace {

using tracer::Image;
using tracer::Vec2i;
using tracer::Vec3d;

constexpr double pixels_a_degree = 67.0206;  // a screen of .7 m and 3840 pixels, .7 m away
constexpr double color_exponent = 0.7;       // q_c
constexpr double feature_exponent = 0.5;     // q_f
constexpr double feature_width_degrees = 0.082;

/// Values of a picture, one channel.
struct Plane {
  Vec2i size{0, 0};
  std::vector<double> values;

  explicit Plane(Vec2i size_px)
      : size(size_px), values(static_cast<size_t>(size_px.x) * size_px.y) {}
  /// What lies beyond an edge is as the edge.
  double at(int x, int y) const {
    const int column = std::clamp(x, 0, size.x - 1);
    const int row = std::clamp(y, 0, size.y - 1);
    return values[static_cast<size_t>(row) * size.x + column];
  }
};

using Kernel = std::vector<double>;  // of odd length, its middle at 0

template <class F>
Plane make_plane(Vec2i size, const F& value_at) {
  Plane plane(size);
  tracer::parallel_for_each_index(0, static_cast<size_t>(size.y), [&](size_t row) {
    for (int x = 0; x < size.x; ++x) {
      plane.values[row * size.x + x] = value_at(x, static_cast<int>(row));
    }
  });
  return plane;
}

/// Convolves with along_x(x) * along_y(y).
Plane convolve(const Plane& plane, const Kernel& along_x, const Kernel& along_y) {
  const auto sum = [](const Kernel& kernel, const auto& value_at) {
    const int radius = static_cast<int>(kernel.size() / 2);
    double total = 0;
    for (int i = -radius; i <= radius; ++i) total += kernel[i + radius] * value_at(i);
    return total;
  };
  const Plane rows = make_plane(plane.size, [&](int x, int y) {
    return sum(along_x, [&](int i) { return plane.at(x + i, y); });
  });
  return make_plane(plane.size, [&](int x, int y) {
    return sum(along_y, [&](int i) { return rows.at(x, y + i); });
  });
}

template <class F>
Kernel make_kernel(int radius, const F& f) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) kernel.push_back(f(i));
  return kernel;
}

double sum_of(const Kernel& kernel) {
  double sum = 0;
  for (const double value : kernel) sum += value;
  return sum;
}

Vec3d to_xyz(const Vec3d& linear) {
  return {0.4124564 * linear.x + 0.3575761 * linear.y + 0.1804375 * linear.z,
          0.2126729 * linear.x + 0.7151522 * linear.y + 0.0721750 * linear.z,
          0.0193339 * linear.x + 0.1191920 * linear.y + 0.9503041 * linear.z};
}

Vec3d to_linear(const Vec3d& xyz) {
  return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
          -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
          0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

Vec3d white() {
  return to_xyz(Vec3d(1));
}

/// Linear L*a*b*: opponent colours in which sight's sensitivity to contrast is known.
Vec3d to_opponent(const Vec3d& linear) {
  const Vec3d part = to_xyz(linear) / white();
  return {116 * part.y - 16, 500 * (part.x - part.y), 200 * (part.y - part.z)};
}

Vec3d from_opponent(const Vec3d& color) {
  const double y = (color.x + 16) / 116;
  return to_linear(Vec3d(color.y / 500 + y, y, y - color.z / 200) * white());
}

/// L*a*b*, its chroma lowered where it is dark [Hunt effect].
Vec3d to_adjusted_lab(const Vec3d& linear) {
  constexpr double edge = 6.0 / 29;
  const auto root = [](double t) {
    return t > edge * edge * edge ? std::cbrt(t) : t / (3 * edge * edge) + 4.0 / 29;
  };
  const Vec3d part = to_xyz(linear) / white();
  const double l = 116 * root(part.y) - 16;
  const double a = 500 * (root(part.x) - root(part.y));
  const double b = 200 * (root(part.y) - root(part.z));
  return {l, 0.01 * l * a, 0.01 * l * b};
}

double hyab(const Vec3d& a, const Vec3d& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// A part of a channel's point spread: weight * sqrt(pi / b) exp(-pi^2 d^2 / b), d in degrees.
struct Spread {
  double weight, b;
};
using ChannelSpread = std::array<Spread, 2>;

// Table 1.
constexpr std::array<ChannelSpread, 3> channel_spreads{
    {{{{1, 0.0047}, {0, 1e-5}}}, {{{1, 0.0053}, {0, 1e-5}}}, {{{34.1, 0.04}, {13.5, 0.025}}}}};

Plane blur(const Plane& plane, const ChannelSpread& spreads) {
  constexpr double pi = std::numbers::pi;
  constexpr double widest = 0.04;
  const int radius =
      static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * pixels_a_degree));
  Plane blurred(plane.size);
  double total = 0;
  for (const Spread& spread : spreads) {
    if (spread.weight == 0) continue;
    const Kernel kernel = make_kernel(radius, [&](int i) {
      const double degrees = i / pixels_a_degree;
      return std::exp(-pi * pi * degrees * degrees / spread.b);
    });
    const double factor = spread.weight * std::sqrt(pi / spread.b);
    const Plane part = convolve(plane, kernel, kernel);
    for (size_t i = 0; i < part.values.size(); ++i) blurred.values[i] += factor * part.values[i];
    total += factor * sum_of(kernel) * sum_of(kernel);
  }
  for (double& value : blurred.values) value /= total;
  return blurred;
}

/// A picture as it is seen: opponent colours.
std::array<Plane, 3> opponent_planes(const Image& image) {
  std::array<Plane, 3> planes{Plane(image.size_px), Plane(image.size_px), Plane(image.size_px)};
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const Vec3d color = to_opponent(clamp(Vec3d(image.pixels[i]), Vec3d(0), Vec3d(1)));
    for (int channel = 0; channel < 3; ++channel) planes[channel].values[i] = color[channel];
  }
  return planes;
}

std::vector<Vec3d> seen_colors(const std::array<Plane, 3>& planes) {
  const std::array<Plane, 3> blurred{blur(planes[0], channel_spreads[0]),
                                     blur(planes[1], channel_spreads[1]),
                                     blur(planes[2], channel_spreads[2])};
  std::vector<Vec3d> colors(planes[0].values.size());
  for (size_t i = 0; i < colors.size(); ++i) {
    const Vec3d opponent(blurred[0].values[i], blurred[1].values[i], blurred[2].values[i]);
    colors[i] = to_adjusted_lab(clamp(from_opponent(opponent), Vec3d(0), Vec3d(1)));
  }
  return colors;
}

/// 4.1.3: what is beyond pc of the largest difference is pressed into what is beyond pt.
double redistribute(double difference, double largest) {
  constexpr double pc = 0.4, pt = 0.95;
  const double edge = pc * largest;
  if (difference < edge) return pt / edge * difference;
  return pt + (difference - edge) / (largest - edge) * (1 - pt);
}

/// Scaled so that what is positive sums to 1 and what is negative to -1.
Kernel balanced(Kernel kernel) {
  double positive = 0, negative = 0;
  for (const double value : kernel) (value > 0 ? positive : negative) += value;
  for (double& value : kernel) value /= value > 0 ? positive : -negative;
  return kernel;
}

/// Strengths of edges and of points, 4.2.
std::pair<Plane, Plane> features(const Plane& opponent_y) {
  const double deviation = 0.5 * feature_width_degrees * pixels_a_degree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  const auto gauss = [&](int i) { return std::exp(-i * i / (2 * deviation * deviation)); };
  Kernel smooth = make_kernel(radius, gauss);
  const double sum = sum_of(smooth);
  for (double& value : smooth) value /= sum;
  const Kernel edge = balanced(make_kernel(radius, [&](int i) { return -i * gauss(i); }));
  const Kernel point = balanced(
      make_kernel(radius, [&](int i) { return (i * i / (deviation * deviation) - 1) * gauss(i); }));
  const Plane grey =
      make_plane(opponent_y.size, [&](int x, int y) { return (opponent_y.at(x, y) + 16) / 116; });
  const auto strength = [&](const Kernel& kernel) {
    const Plane across = convolve(grey, kernel, smooth);
    const Plane down = convolve(grey, smooth, kernel);
    return make_plane(grey.size,
                      [&](int x, int y) { return std::hypot(across.at(x, y), down.at(x, y)); });
  };
  return {strength(edge), strength(point)};
}

}  // namespace

double mean_flip(const Image& test, const Image& reference) {
  const auto test_planes = opponent_planes(test);
  const auto reference_planes = opponent_planes(reference);
  const std::vector<Vec3d> test_colors = seen_colors(test_planes);
  const std::vector<Vec3d> reference_colors = seen_colors(reference_planes);
  const auto [test_edges, test_points] = features(test_planes[0]);
  const auto [reference_edges, reference_points] = features(reference_planes[0]);
  const double largest = std::pow(
      hyab(to_adjusted_lab(Vec3d(0, 1, 0)), to_adjusted_lab(Vec3d(0, 0, 1))), color_exponent);
  double sum = 0;
  for (size_t i = 0; i < test_colors.size(); ++i) {
    const double color =
        redistribute(std::pow(hyab(test_colors[i], reference_colors[i]), color_exponent), largest);
    const double edge = std::abs(test_edges.values[i] - reference_edges.values[i]);
    const double point = std::abs(test_points.values[i] - reference_points.values[i]);
    const double feature = std::pow(std::max(edge, point) / std::numbers::sqrt2, feature_exponent);
    sum += std::pow(color, 1 - feature);
  }
  return sum / static_cast<double>(test_colors.size());
}

}  // namespace bench
