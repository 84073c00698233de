// SPDX-License-Identifier: MIT
#include "app/shown_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tracer/render/film_error.h"

namespace app {
namespace {

// sRGB, from night through red to daylight; evenly lighter, so that it reads without colours too.
constexpr std::array<tracer::Vec3f, 6> stops{{{0.02f, 0.02f, 0.10f},
                                              {0.24f, 0.09f, 0.42f},
                                              {0.55f, 0.16f, 0.42f},
                                              {0.87f, 0.32f, 0.22f},
                                              {0.98f, 0.64f, 0.15f},
                                              {0.99f, 0.98f, 0.78f}}};

double error_part(double error) {
  const double decades = std::log10(greatest_shown_error / least_shown_error);
  return error > 0 ? std::log10(error / least_shown_error) / decades : 0;
}

tracer::Vec3f shown_pixel(const tracer::Film& film, int x, int y, ShownMap map,
                          uint32_t sample_count) {
  switch (map) {
    case ShownMap::samples:
      return map_color(film.sample_count(x, y) / std::max(1.0, static_cast<double>(sample_count)));
    case ShownMap::error:
      return map_color(error_part(tracer::pixel_error(film, x, y)));
    case ShownMap::picture:
      break;
  }
  return film.mean(x, y);
}

}  // namespace

tracer::Vec3f map_color(double part) {
  constexpr float decoding = 2.2f;
  const double place = std::clamp(part, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const size_t stop = std::min(static_cast<size_t>(place), stops.size() - 2);
  const auto fraction = static_cast<float>(place - static_cast<double>(stop));
  return pow(mix(stops[stop], stops[stop + 1], fraction), tracer::Vec3f(decoding));
}

std::vector<tracer::Vec3f> shown_pixels(const tracer::Film& film, const tracer::Tile& tile,
                                        ShownMap map, uint32_t sample_count) {
  std::vector<tracer::Vec3f> pixels;
  pixels.reserve(static_cast<size_t>(tile.width()) * tile.height());
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) {
      pixels.push_back(shown_pixel(film, x, y, map, sample_count));
    }
  }
  return pixels;
}

}  // namespace app
