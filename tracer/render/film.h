// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "tracer/base/vectors.h"
#include "tracer/render/sample_rates.h"

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

/// The mean of a pixel's first samples, and of those after.
struct SampleHalves {
  Vec3d first{0}, rest{0};
  uint32_t first_count = 0, rest_count = 0;  // both 0 where there are fewer than 2 samples
};

/// Sums of samples in double, one owner a pixel at a time; a pixel's samples are added in the
/// order of their index, so the bits do not depend on threads or tiles.
class Film {
 public:
  explicit Film(Vec2i size_px);

  Vec2i size_px() const { return size_px_; }
  uint32_t sample_count(int x, int y) const { return pixels_[index(x, y)].count; }
  void add(int x, int y, const Vec3d& radiance) {
    Pixel& pixel = pixels_[index(x, y)];
    if ((pixel.count & (pixel.count - 1)) == 0 && pixel.count > 0) keep_prefix(index(x, y));
    pixel.sum += radiance;
    ++pixel.count;
  }
  /// Mean radiance; where a pixel has no sample yet, that of the nearest pixel up and left on a
  /// coarser grid (8, 4, 2) that has one, else black.
  Vec3f mean(int x, int y) const;
  Image image() const;
  /// The first 2^k samples and the rest, a fifth to three fifths of all: what they tell about the
  /// error of all together is in film_error.h.
  SampleHalves halves(int x, int y) const;
  /// Even when new and when cleared.
  const SampleRates& rates() const { return rates_; }
  void set_rates(SampleRates rates) { rates_ = std::move(rates); }
  /// Whether the pixel is due for a sample, when the pixels of rate 1 are to have `count` of them.
  bool is_due(int x, int y, uint32_t count) const {
    if (rates_.are_even()) return sample_count(x, y) < count;
    return sample_count(x, y) < std::ceil(rates_.rate(x, y) * static_cast<double>(count));
  }
  void clear();

 private:
  // Together: who asks for the count adds to the sum soon after.
  struct Pixel {
    Vec3d sum{0};
    uint32_t count = 0;
  };
  // Means of the first samples, as many as the two largest powers of two below the count.
  struct Prefixes {
    Vec3f shorter{0}, longer{0};
  };

  size_t index(int x, int y) const { return static_cast<size_t>(y) * size_px_.x + x; }
  void keep_prefix(size_t pixel) {
    Prefixes& prefixes = prefixes_[pixel];
    prefixes.shorter = prefixes.longer;
    prefixes.longer = Vec3f(pixels_[pixel].sum / static_cast<double>(pixels_[pixel].count));
  }

  Vec2i size_px_;
  std::vector<Pixel> pixels_;
  std::vector<Prefixes> prefixes_;
  SampleRates rates_;
};

}  // namespace tracer
