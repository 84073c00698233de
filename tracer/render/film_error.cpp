// SPDX-License-Identifier: MIT
#include "tracer/render/film_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tracer/base/parallel.h"

namespace tracer {
namespace {

// Pixels of a square may share random numbers; squares do not.
constexpr int square_side = 16;

double mean_error(const Film& film, const Tile& square) {
  double sum = 0;
  for (int y = square.y0; y < square.y1; ++y) {
    for (int x = square.x0; x < square.x1; ++x) sum += pixel_error(film, x, y);
  }
  return sum / (square.width() * square.height());
}

/// Of the pixels at the pixel's corners; of the pixel itself where there are none.
Vec3d mean_at_corners(const Film& film, int x, int y) {
  Vec3d sum(0);
  int count = 0;
  for (const Vec2i by : {Vec2i(-1, -1), Vec2i(1, -1), Vec2i(-1, 1), Vec2i(1, 1)}) {
    const Vec2i pixel = Vec2i(x, y) + by;
    if (std::min(pixel.x, pixel.y) < 0) continue;
    if (pixel.x >= film.size_px().x || pixel.y >= film.size_px().y) continue;
    sum += Vec3d(film.mean(pixel.x, pixel.y));
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : Vec3d(film.mean(x, y));
}

}  // namespace

double FilmError::upper_bound() const {
  // The error varies by chance as much as its estimate does, and apart from it.
  constexpr double one_sided_95_percent = 1.645;
  return relmse + one_sided_95_percent * std::numbers::sqrt2 * standard_error;
}

double pixel_error(const Film& film, int x, int y) {
  const SampleHalves halves = film.halves(x, y);
  if (halves.rest_count == 0) return std::numeric_limits<double>::infinity();
  const double first_count = halves.first_count, rest_count = halves.rest_count;
  const Vec3d around = mean_at_corners(film, x, y);
  // By the darker half's brightness, or else a flash of light in the other would hide itself; a few
  // samples alone say little about it.
  const auto weight = [&](const Vec3d& mean, double count) {
    constexpr double count_around = 8;
    const Vec3d likely = (count * mean + count_around * around) / (count + count_around);
    return 1.0 / (likely * likely + relmse_epsilon);
  };
  const Vec3d difference = halves.first - halves.rest;
  const Vec3d sum = difference * difference *
                    glm::max(weight(halves.first, first_count), weight(halves.rest, rest_count));
  const double count = first_count + rest_count;
  return first_count * rest_count / (count * count) * (sum.x + sum.y + sum.z) / 3;
}

FilmError estimate_error(const Film& film) {
  const std::vector<Tile> squares = make_tiles(film.size_px(), square_side);
  std::vector<double> errors(squares.size());
  parallel_for_each_index(size_t{0}, squares.size(),
                          [&](size_t i) { errors[i] = mean_error(film, squares[i]); });
  const double pixel_count = static_cast<double>(film.size_px().x) * film.size_px().y;
  const auto weight_of = [&](const Tile& square) {
    return square.width() * square.height() / pixel_count;
  };
  FilmError error;
  for (size_t i = 0; i < squares.size(); ++i) error.relmse += weight_of(squares[i]) * errors[i];
  double variance = 0;
  for (size_t i = 0; i < squares.size(); ++i) {
    const double deviation = weight_of(squares[i]) * (errors[i] - error.relmse);
    variance += deviation * deviation;
  }
  // Of one square alone nothing is known.
  const double count = static_cast<double>(squares.size());
  error.standard_error = count > 1 ? std::sqrt(variance * count / (count - 1)) : error.relmse;
  return error;
}

}  // namespace tracer
