// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "tracer/base/vectors.h"

namespace tracer {

/// Linear RGB radiance, row 0 on top.
struct Image {
  Vec2i size_px{0, 0};
  std::vector<Vec3f> pixels;
};

/// Pixels [x0, x1) x [y0, y1).
struct Tile {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
};

inline constexpr int tile_size_px = 64;

/// Tiles of an image in the order they are rendered: from the centre outwards, where people look.
std::vector<Tile> make_tiles(Vec2i size_px, int side_px = tile_size_px);

/// Sums of samples in double, one owner a pixel at a time; a pixel's samples are added in the
/// order of their index, so the bits do not depend on threads or tiles.
class Film {
 public:
  explicit Film(Vec2i size_px);

  Vec2i size_px() const { return size_px_; }
  uint32_t sample_count(int x, int y) const { return pixels_[index(x, y)].count; }
  void add(int x, int y, const Vec3d& radiance) {
    Pixel& pixel = pixels_[index(x, y)];
    pixel.sum += radiance;
    ++pixel.count;
  }
  /// Mean radiance; where a pixel has no sample yet, that of the nearest pixel up and left on a
  /// coarser grid (8, 4, 2) that has one, else black.
  Vec3f mean(int x, int y) const;
  Image image() const;
  void clear();

 private:
  // Together: who asks for the count adds to the sum soon after.
  struct Pixel {
    Vec3d sum{0};
    uint32_t count = 0;
  };

  size_t index(int x, int y) const { return static_cast<size_t>(y) * size_px_.x + x; }

  Vec2i size_px_;
  std::vector<Pixel> pixels_;
};

}  // namespace tracer
