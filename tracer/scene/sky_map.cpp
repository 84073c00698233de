// SPDX-License-Identifier: MIT
#include "tracer/scene/sky_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tracer/base/parallel.h"
#include "tracer/base/trigonometry.h"

namespace tracer {
namespace {

int wrapped(int column, int width) {
  return column < 0 ? column + width : column >= width ? column - width : column;
}

const Vec3f& texel(const LatLongImage& image, int column, int row) {
  const int y = std::clamp(row, 0, image.height - 1);
  return image.texels[static_cast<size_t>(y) * image.width + wrapped(column, image.width)];
}

/// Mean over a texel of what bilinear interpolation makes of it and its neighbours.
double mean_luminance(const LatLongImage& image, int column, int row) {
  constexpr double weights[3] = {0.125, 0.75, 0.125};
  Vec3d sum(0);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      sum += weights[dx + 1] * weights[dy + 1] * Vec3d(texel(image, column + dx, row + dy));
    }
  }
  return luminance(sum);
}

}  // namespace

SkyMap::SkyMap(LatLongImage image) : image_(std::move(image)) {
  const int width = image_.width;
  const int height = image_.height;
  for (int row = 0; row <= height; ++row) {
    heights_.push_back(cos_sin_of_turns(0.5 * row / height).cos);
  }
  std::vector<double> weights(image_.texels.size());
  std::vector<double> row_sums(height);
  parallel_for_ranges(0, static_cast<size_t>(height), 16, [&](size_t begin, size_t end) {
    for (size_t row = begin; row < end; ++row) {
      const double measure = cell_measure(static_cast<int>(row));
      for (int column = 0; column < width; ++column) {
        double& weight = weights[row * width + column];
        weight = measure * mean_luminance(image_, column, static_cast<int>(row));
        row_sums[row] += weight;
      }
    }
  });
  for (const double sum : row_sums) power_ += sum;
  if (power_ > 0) cells_ = Distribution2d(width, height, weights);
}

double SkyMap::cell_measure(int row) const {
  return (heights_[row] - heights_[row + 1]) * (2 * std::numbers::pi / image_.width);
}

Vec2d SkyMap::place_of(const Vec3d& direction) const {
  const double level = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  const double azimuth = quick_turns_of(-direction.x, -direction.z);
  const double descent = 2 * quick_turns_of(direction.y, level);
  return {azimuth * image_.width, descent * image_.height};
}

Vec3d SkyMap::radiance(const Vec3d& direction) const {
  const Vec2d place = place_of(direction) - Vec2d(0.5);
  const double column = std::floor(place.x);
  const double row = std::floor(place.y);
  const Vec2d weight(place.x - column, place.y - row);
  const int x = static_cast<int>(column);
  const int y = static_cast<int>(row);
  const auto mix = [](const Vec3f& a, const Vec3f& b, double part) {
    return (1 - part) * Vec3d(a) + part * Vec3d(b);
  };
  const Vec3d upper = mix(texel(image_, x, y), texel(image_, x + 1, y), weight.x);
  const Vec3d lower = mix(texel(image_, x, y + 1), texel(image_, x + 1, y + 1), weight.x);
  return (1 - weight.y) * upper + weight.y * lower;
}

SkyMap::Sample SkyMap::sample(const Vec2d& u) const {
  if (!(power_ > 0)) return {{0, 1, 0}, 0};
  const Distribution2d::Pick pick = cells_.pick(u);
  const double y =
      heights_[pick.row] + pick.place.y * (heights_[pick.row + 1] - heights_[pick.row]);
  const CosSin around = cos_sin_of_turns((pick.column + pick.place.x) / image_.width);
  const double level = std::sqrt(std::max(0.0, 1 - y * y));
  return {{-level * around.cos, y, -level * around.sin}, pick.probability / cell_measure(pick.row)};
}

double SkyMap::pdf(const Vec3d& direction) const {
  if (!(power_ > 0)) return 0;
  const Vec2d place = place_of(direction);
  const int column = std::clamp(static_cast<int>(place.x), 0, image_.width - 1);
  const int row = std::clamp(static_cast<int>(place.y), 0, image_.height - 1);
  return cells_.probability(column, row) / cell_measure(row);
}

}  // namespace tracer
