// SPDX-License-Identifier: MIT
#include "tracer/scene/texture.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tracer/base/error.h"

namespace tracer {
namespace {

/// A binary PPM, which stb reads as 8-bit.
std::string ppm(int width, int height, const std::string& rgb) {
  return "P6\n" + std::to_string(width) + ' ' + std::to_string(height) + "\n255\n" + rgb;
}

Texture load(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  return load_texture(folder.write(name, bytes));
}

std::string load_error(const std::string& bytes) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.write("t.png", bytes);
  try {
    load_texture(path);
  } catch (const LoadError& error) {
    return std::string(error.what()).substr(path.string().size());
  }
  return "";
}

/// Two by two: red and green above, blue and black below.
Texture four_texels() {
  return {2, 2, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};
}

TEST(Texture, eight_bit_codes_become_linear_by_the_srgb_curve) {
  using namespace std::string_literals;
  const Texture texture = load("t.ppm", ppm(2, 1, "\x00\x0a\xff\x80\xbc\x0b"s));
  ASSERT_EQ(texture.width, 2);
  ASSERT_EQ(texture.height, 1);
  EXPECT_EQ(texture.texels[0].x, 0.0f);
  EXPECT_FLOAT_EQ(texture.texels[0].y, 10 / 255.0f / 12.92f);
  EXPECT_EQ(texture.texels[0].z, 1.0f);
  EXPECT_NEAR(texture.texels[1].x, 0.2158605f, 1e-7f);
  EXPECT_NEAR(texture.texels[1].y, 0.5028865f, 1e-7f);
  EXPECT_NEAR(texture.texels[1].z, 0.0033465f, 1e-7f);
}

TEST(Texture, hdr_files_keep_their_radiance) {
  using namespace std::string_literals;
  const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"s +
                          "\x80\x40\x20\x82"s + "\x00\x00\x00\x00"s;
  const Texture texture = load("t.hdr", hdr);
  ASSERT_EQ(texture.texels.size(), 2u);
  EXPECT_EQ(texture.texels[0], Vec3f(2, 1, 0.5f));
  EXPECT_EQ(texture.texels[1], Vec3f(0));
}

TEST(Texture, row_0_is_on_top_and_v_points_up) {
  const Texture texture = four_texels();
  EXPECT_EQ(eval_texture(texture, {0.25f, 0.75f}), Vec3f(1, 0, 0));
  EXPECT_EQ(eval_texture(texture, {0.75f, 0.75f}), Vec3f(0, 1, 0));
  EXPECT_EQ(eval_texture(texture, {0.25f, 0.25f}), Vec3f(0, 0, 1));
  EXPECT_EQ(eval_texture(texture, {0.75f, 0.25f}), Vec3f(0, 0, 0));
}

TEST(Texture, between_texels_it_is_bilinear) {
  EXPECT_EQ(eval_texture(four_texels(), {0.5f, 0.5f}), Vec3f(0.25f, 0.25f, 0.25f));
  EXPECT_EQ(eval_texture(four_texels(), {0.5f, 0.75f}), Vec3f(0.5f, 0.5f, 0));
}

TEST(Texture, it_repeats_and_its_edges_meet) {
  const Texture texture = four_texels();
  for (const int shift : {-3, -1, 1, 1000}) {
    const auto offset = static_cast<float>(shift);
    EXPECT_EQ(eval_texture(texture, {0.25f + offset, 0.75f + offset}), Vec3f(1, 0, 0));
  }
  EXPECT_EQ(eval_texture(texture, {0.0f, 0.75f}), Vec3f(0.5f, 0.5f, 0));
  EXPECT_EQ(eval_texture(texture, {1.0f, 0.75f}), Vec3f(0.5f, 0.5f, 0));
}

TEST(Texture, any_float_is_a_coordinate) {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float u : {infinity, -infinity, nan, 1e30f, -1e30f, -1e-30f, 1e-45f, 0.99999994f}) {
    for (const float v : {0.5f, u}) {
      EXPECT_TRUE(is_finite(eval_texture(four_texels(), {u, v}))) << u;
      EXPECT_EQ(eval_texture({1, 1, {{1, 2, 3}}}, {u, v}), Vec3f(1, 2, 3)) << u;
    }
  }
}

TEST(Texture, what_is_no_image_is_an_error_in_words) {
  EXPECT_EQ(load_error(""), ": the image file is empty");
  EXPECT_EQ(load_error("hello"), ": no image that can be read: unknown image type");
  EXPECT_EQ(load_error("P6\n60000 60000\n255\nx"), ": the image has too many pixels");
  EXPECT_EQ(load_error("P5\n1 2\n260 x"), ": a PNM too large, or of more than 8 bits");
  EXPECT_EQ(load_error("P5 99999999999 # 1\n1 255\n"), ": a PNM too large, or of more than 8 bits");
  EXPECT_EQ(load_error("P5\n"), ": the image has no pixels");
  EXPECT_NE(load_error("\x89PNG\r\n\x1a\n"), "");
  EXPECT_THROW(load_texture("/nowhere/to/be/found.png"), LoadError);
}

}  // namespace
}  // namespace tracer
