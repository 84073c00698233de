// SPDX-License-Identifier: MIT
#include "tracer/render/film.h"

#include <gtest/gtest.h>

namespace tracer {
namespace {

TEST(Tiles, cover_every_pixel_once) {
  for (const Vec2i size : {Vec2i(1, 1), Vec2i(64, 64), Vec2i(65, 63), Vec2i(1000, 3)}) {
    std::vector<int> covered(static_cast<size_t>(size.x) * size.y);
    for (const Tile& tile : make_tiles(size)) {
      ASSERT_LE(tile.width(), tile_size_px);
      for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) ++covered[static_cast<size_t>(y) * size.x + x];
      }
    }
    for (const int count : covered) ASSERT_EQ(count, 1);
  }
}

TEST(Tiles, come_from_the_centre_outwards) {
  const Vec2i size(1280, 720);
  double last = 0;
  for (const Tile& tile : make_tiles(size)) {
    const Vec2d center(0.5 * (tile.x0 + tile.x1), 0.5 * (tile.y0 + tile.y1));
    const double distance = glm::length(center - 0.5 * Vec2d(size));
    EXPECT_GE(distance, last - 1e-9);
    last = distance;
  }
}

TEST(Film, is_without_holes_after_the_coarsest_pass) {
  Film film({100, 50});
  for (int y = 0; y < 50; y += 8) {
    for (int x = 0; x < 100; x += 8) film.add(x, y, Vec3d(x, y, 1));
  }
  const Image image = film.image();
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 100; ++x) {
      ASSERT_EQ(image.pixels[static_cast<size_t>(y) * 100 + x], Vec3f(x / 8 * 8, y / 8 * 8, 1));
    }
  }
}

TEST(Film, finer_grids_come_before_coarser_ones) {
  Film film({8, 8});
  film.add(0, 0, Vec3d(8));
  film.add(4, 4, Vec3d(4));
  film.add(6, 4, Vec3d(2));
  EXPECT_EQ(film.mean(7, 5), Vec3f(2));
  EXPECT_EQ(film.mean(5, 7), Vec3f(4));
  EXPECT_EQ(film.mean(3, 7), Vec3f(8));
}

TEST(Film, is_black_and_empty_when_new_and_when_cleared) {
  Film film({3, 2});
  film.add(2, 1, Vec3d(1));
  film.clear();
  EXPECT_EQ(film.sample_count(2, 1), 0u);
  EXPECT_EQ(film.mean(2, 1), Vec3f(0));
  EXPECT_EQ(film.image().pixels.size(), 6u);
}

}  // namespace
}  // namespace tracer
