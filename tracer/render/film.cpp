// SPDX-License-Identifier: MIT
#include "tracer/render/film.h"

#include <algorithm>
#include <bit>

#include "tracer/base/parallel.h"

namespace tracer {

std::vector<Tile> make_tiles(Vec2i size_px, int side_px) {
  std::vector<Tile> tiles;
  for (int y = 0; y < size_px.y; y += side_px) {
    for (int x = 0; x < size_px.x; x += side_px) {
      tiles.push_back({x, y, std::min(x + side_px, size_px.x), std::min(y + side_px, size_px.y)});
    }
  }
  const auto distance = [&](const Tile& tile) {
    const double dx = static_cast<double>(tile.x0) + tile.x1 - size_px.x;
    const double dy = static_cast<double>(tile.y0) + tile.y1 - size_px.y;
    return dx * dx + dy * dy;
  };
  std::stable_sort(tiles.begin(), tiles.end(),
                   [&](const Tile& a, const Tile& b) { return distance(a) < distance(b); });
  return tiles;
}

Film::Film(Vec2i size_px)
    : size_px_(size_px),
      pixels_(static_cast<size_t>(size_px.x) * size_px.y),
      prefixes_(pixels_.size()) {}

Vec3f Film::mean(int x, int y) const {
  for (const int stride : {1, 2, 4, 8}) {
    const Pixel& pixel = pixels_[index(x - x % stride, y - y % stride)];
    if (pixel.count > 0) return Vec3f(pixel.sum / static_cast<double>(pixel.count));
  }
  return Vec3f(0);
}

Image Film::image() const {
  Image image{size_px_, std::vector<Vec3f>(pixels_.size())};
  parallel_for_ranges(0, static_cast<size_t>(size_px_.y), 16, [&](size_t begin, size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < size_px_.x; ++x) image.pixels[index(x, y)] = mean(x, y);
    }
  });
  return image;
}

SampleHalves Film::halves(int x, int y) const {
  const Pixel& pixel = pixels_[index(x, y)];
  if (pixel.count < 2) return {};
  const Prefixes& prefixes = prefixes_[index(x, y)];
  const uint32_t longer = std::bit_floor(pixel.count - 1);
  // One sample behind sixteen says nothing.
  const bool is_longer_used = pixel.count >= longer + longer / 4;
  const uint32_t first_count = is_longer_used ? longer : longer / 2;
  const Vec3d first(is_longer_used ? prefixes.longer : prefixes.shorter);
  const uint32_t rest_count = pixel.count - first_count;
  return {first,
          (pixel.sum - static_cast<double>(first_count) * first) / static_cast<double>(rest_count),
          first_count, rest_count};
}

void Film::clear() {
  std::fill(pixels_.begin(), pixels_.end(), Pixel{});
  std::fill(prefixes_.begin(), prefixes_.end(), Prefixes{});
  rates_ = {};
}

}  // namespace tracer
