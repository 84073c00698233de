// SPDX-License-Identifier: MIT
#include "app/viewer/picture.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace app {

void Picture::update(tracer::Vec2i size_px, std::span<const FinishedTile> tiles) {
  if (tiles.empty()) return;
  if (linear_.size_px != size_px) stretch(size_px);
  for (const FinishedTile& finished : tiles) {
    const tracer::Tile& tile = finished.tile;
    for (int row = 0; row < tile.height(); ++row) {
      const size_t first = static_cast<size_t>(tile.y0 + row) * size_px.x + tile.x0;
      const size_t width = static_cast<size_t>(tile.width());
      const auto source = std::span(finished.pixels).subspan(row * width, width);
      std::copy(source.begin(), source.end(), linear_.pixels.begin() + first);
      tracer::develop(source, exposure_, std::span(developed_).subspan(first, width));
    }
    changed_.push_back(tile);
  }
}

void Picture::set_exposure(double exposure) {
  if (std::exchange(exposure_, exposure) != exposure) develop_all();
}

std::vector<tracer::Tile> Picture::take_changes() {
  return std::exchange(changed_, {});
}

void Picture::stretch(tracer::Vec2i size_px) {
  const tracer::Image before = std::move(linear_);
  linear_ = {size_px, std::vector<tracer::Vec3f>(static_cast<size_t>(size_px.x) * size_px.y)};
  developed_.resize(linear_.pixels.size());
  if (!before.pixels.empty()) {
    for (int y = 0; y < size_px.y; ++y) {
      const int64_t row = int64_t{y} * before.size_px.y / size_px.y;
      for (int x = 0; x < size_px.x; ++x) {
        const int64_t column = int64_t{x} * before.size_px.x / size_px.x;
        linear_.pixels[static_cast<size_t>(y) * size_px.x + x] =
            before.pixels[row * before.size_px.x + column];
      }
    }
  }
  changed_.clear();
  develop_all();
}

void Picture::develop_all() {
  if (is_empty()) return;
  tracer::develop(linear_.pixels, exposure_, developed_);
  changed_ = {tracer::Tile{0, 0, linear_.size_px.x, linear_.size_px.y}};
}

}  // namespace app
