// SPDX-License-Identifier: MIT
#include "app/viewer/picture.h"

#include <gtest/gtest.h>

namespace app {
namespace {

using tracer::Tile;
using tracer::Vec2i;
using tracer::Vec3f;

FinishedTile make_tile(const Tile& tile, float value) {
  return {tile,
          std::vector<Vec3f>(static_cast<size_t>(tile.width()) * tile.height(), Vec3f(value))};
}

TEST(Picture, takes_tiles_where_they_belong) {
  Picture picture;
  const std::vector<FinishedTile> tiles{make_tile({0, 0, 2, 1}, 0.25f),
                                        make_tile({2, 1, 3, 2}, 1.0f)};
  picture.update(Vec2i(3, 2), tiles);
  EXPECT_EQ(picture.linear().pixels[0], Vec3f(0.25f));
  EXPECT_EQ(picture.linear().pixels[5], Vec3f(1.0f));
  EXPECT_EQ(picture.linear().pixels[2], Vec3f(0.0f));
  EXPECT_EQ(picture.developed()[0].r, tracer::encode_srgb(0.25f));
  EXPECT_EQ(picture.developed()[5].g, 255);
}

TEST(Picture, later_tiles_change_their_own_area_alone) {
  Picture picture;
  picture.update(Vec2i(4, 4), std::vector{make_tile({0, 0, 4, 4}, 0.5f)});
  picture.take_changes();
  picture.update(Vec2i(4, 4), std::vector{make_tile({2, 0, 4, 2}, 1.0f)});
  const std::vector<Tile> changes = picture.take_changes();
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].x0, 2);
  EXPECT_EQ(changes[0].width() * changes[0].height(), 4);
  EXPECT_FALSE(picture.has_changes());
}

TEST(Picture, exposure_develops_again_and_leaves_radiance_alone) {
  Picture picture;
  picture.update(Vec2i(2, 2), std::vector{make_tile({0, 0, 2, 2}, 0.25f)});
  picture.take_changes();
  picture.set_exposure(1);
  EXPECT_TRUE(picture.has_changes());
  EXPECT_EQ(picture.developed()[3].b, tracer::encode_srgb(0.5f));
  EXPECT_EQ(picture.linear().pixels[3], Vec3f(0.25f));
}

TEST(Picture, another_size_shows_the_stretched_picture_until_its_tiles_come) {
  Picture picture;
  picture.update(Vec2i(2, 1),
                 std::vector{make_tile({0, 0, 1, 1}, 0.25f), make_tile({1, 0, 2, 1}, 0.75f)});
  picture.update(Vec2i(4, 2), std::vector{make_tile({0, 0, 1, 1}, 1.0f)});
  EXPECT_EQ(picture.size_px(), Vec2i(4, 2));
  EXPECT_EQ(picture.linear().pixels[0], Vec3f(1.0f));
  EXPECT_EQ(picture.linear().pixels[1], Vec3f(0.25f));
  EXPECT_EQ(picture.linear().pixels[7], Vec3f(0.75f));
}

}  // namespace
}  // namespace app
