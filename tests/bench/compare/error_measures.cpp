// SPDX-License-Identifier: MIT
#include "tests/bench/compare/error_measures.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/bench/compare/flip.h"
#include "tracer/render/film_error.h"

namespace bench {
namespace {

using tracer::Image;
using tracer::Vec3d;

/// The mean over pixels and channels of f(pixel), which is a Vec3d.
template <class F>
double mean_over(const Image& image, const F& f) {
  Vec3d sum(0);
  for (size_t i = 0; i < image.pixels.size(); ++i) sum += f(i);
  return (sum.x + sum.y + sum.z) / (3 * static_cast<double>(image.pixels.size()));
}

Vec3d mean_of(const Reference& reference, size_t pixel) {
  return 0.5 * (Vec3d(reference.first.pixels[pixel]) + Vec3d(reference.second.pixels[pixel]));
}

Vec3d scale_of(const Reference& reference, size_t pixel) {
  const Vec3d mean = mean_of(reference, pixel);
  return 1.0 / (mean * mean + tracer::relmse_epsilon);
}

Image mean_image(const Reference& reference) {
  Image image{reference.first.size_px, {}};
  image.pixels.reserve(reference.first.pixels.size());
  for (size_t i = 0; i < reference.first.pixels.size(); ++i) {
    image.pixels.emplace_back(mean_of(reference, i));
  }
  return image;
}

void check_sizes(const Image& picture, const Reference& reference) {
  if (picture.size_px != reference.first.size_px) {
    throw std::invalid_argument("a picture and its reference differ in size");
  }
}

}  // namespace

double systematic_relmse(const Image& x, const Image& y, const Reference& reference) {
  check_sizes(x, reference);
  check_sizes(y, reference);
  return mean_over(x, [&](size_t i) {
    return (Vec3d(x.pixels[i]) - Vec3d(reference.first.pixels[i])) *
           (Vec3d(y.pixels[i]) - Vec3d(reference.second.pixels[i])) * scale_of(reference, i);
  });
}

ErrorMeasures measure_errors(const Image& picture, const Reference& reference) {
  const double mse = mean_over(picture, [&](size_t i) {
    const Vec3d pixel(picture.pixels[i]);
    return (pixel - Vec3d(reference.first.pixels[i])) * (pixel - Vec3d(reference.second.pixels[i]));
  });
  return {
      .relmse = systematic_relmse(picture, picture, reference),
      .rmse = std::sqrt(std::max(mse, 0.0)),
      .mae = mean_over(
          picture, [&](size_t i) { return abs(Vec3d(picture.pixels[i]) - mean_of(reference, i)); }),
      .flip = mean_flip(picture, mean_image(reference))};
}

double reference_relmse(const Reference& reference) {
  return mean_over(reference.first, [&](size_t i) {
    const Vec3d half = 0.5 * (Vec3d(reference.first.pixels[i]) - Vec3d(reference.second.pixels[i]));
    return half * half * scale_of(reference, i);
  });
}

}  // namespace bench
