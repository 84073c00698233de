// SPDX-License-Identifier: MIT
#include "tracer/scene/texture.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tracer/base/error.h"
#include "tracer/render/image_formats.h"
#include "tracer/scene/srgb_codes.h"

namespace tracer {
namespace {

/// A binary PPM, which stb reads as 8-bit.
std::string ppm(int width, int height, const std::string& rgb) {
  return "P6\n" + std::to_string(width) + ' ' + std::to_string(height) + "\n255\n" + rgb;
}

Texture load(const std::string& name, const std::string& bytes,
             TexelEncoding encoding = TexelEncoding::srgb) {
  const TemporaryFolder folder;
  return load_texture(folder.write(name, bytes), encoding);
}

Vec3f color_at(const Texture& texture, int x, int y, size_t level = 0) {
  return Vec3f(texel_at(texture, texture.levels.at(level), x, y));
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
  return make_texture(2, 2, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}});
}

TEST(Texture, eight_bit_codes_become_linear_by_the_srgb_curve) {
  using namespace std::string_literals;
  const Texture texture = load("t.ppm", ppm(2, 1, "\x00\x0a\xff\x80\xbc\x0b"s));
  ASSERT_EQ(texture.width, 2);
  ASSERT_EQ(texture.height, 1);
  EXPECT_EQ(color_at(texture, 0, 0).x, 0.0f);
  EXPECT_FLOAT_EQ(color_at(texture, 0, 0).y, 10 / 255.0f / 12.92f);
  EXPECT_EQ(color_at(texture, 0, 0).z, 1.0f);
  EXPECT_NEAR(color_at(texture, 1, 0).x, 0.2158605f, 1e-7f);
  EXPECT_NEAR(color_at(texture, 1, 0).y, 0.5028865f, 1e-7f);
  EXPECT_NEAR(color_at(texture, 1, 0).z, 0.0033465f, 1e-7f);
}

TEST(Texture, hdr_files_keep_their_radiance) {
  using namespace std::string_literals;
  const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"s +
                          "\x80\x40\x20\x82"s + "\x00\x00\x00\x00"s;
  const Texture texture = load("t.hdr", hdr);
  ASSERT_EQ(texture.width, 2);
  EXPECT_EQ(color_at(texture, 0, 0), Vec3f(2, 1, 0.5f));
  EXPECT_EQ(color_at(texture, 1, 0), Vec3f(0));
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
      EXPECT_EQ(eval_texture(make_texture(1, 1, {{1, 2, 3}}), {u, v}), Vec3f(1, 2, 3)) << u;
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

TEST(Texture, images_of_8_bits_stay_so_and_numbers_are_linear) {
  using namespace std::string_literals;
  const Texture grey = load("t.pgm", "P5\n1 1\n255\n\x33"s, TexelEncoding::linear);
  EXPECT_EQ(grey.channel_count, 1);
  EXPECT_EQ(grey.codes.size(), 1u);
  EXPECT_TRUE(grey.values.empty());
  EXPECT_EQ(color_at(grey, 0, 0), Vec3f(0.2f));
}

TEST(Texture, halvings_are_means_of_light_not_of_codes) {
  using namespace std::string_literals;
  const Texture texture = load("t.ppm", ppm(2, 1, "\0\0\0\xff\xff\xff"s));
  ASSERT_EQ(texture.levels.size(), 2u);
  // 188 is the code nearest to half the light.
  EXPECT_EQ(texture.codes.at(6), 188);
}

TEST(Texture, every_texel_counts_in_the_halvings_of_odd_sizes) {
  std::vector<Vec3f> texels(5 * 3, Vec3f(0));
  texels.back() = Vec3f(1);
  const Texture texture = make_texture(5, 3, texels);
  ASSERT_EQ(texture.levels.size(), 3u);
  EXPECT_EQ(color_at(texture, 1, 0, 1), Vec3f(1.0f / 9));
  EXPECT_GT(color_at(texture, 0, 0, 2).x, 0.0f);
}

TEST(Texture, footprints_blend_the_halvings) {
  const Texture texture = make_texture(2, 1, {Vec3f(0), Vec3f(1)});
  const auto at = [&](double footprint) {
    return eval_texture(texture, {0.25, 0.5}, footprint, Wrapping::repeat).x;
  };
  EXPECT_EQ(at(0), 0.0f);
  EXPECT_EQ(at(1), 0.0f);
  EXPECT_EQ(at(1.5), 0.25f);
  EXPECT_EQ(at(2), 0.5f);
  EXPECT_EQ(at(1e30), 0.5f);
  EXPECT_EQ(at(std::numeric_limits<double>::infinity()), 0.5f);
  EXPECT_EQ(at(std::numeric_limits<double>::quiet_NaN()), 0.0f);
}

TEST(Texture, clamped_it_ends_in_its_border) {
  const Texture texture = four_texels();
  const auto at = [&](double u, double v) {
    return Vec3f(eval_texture(texture, {u, v}, 0, Wrapping::clamp));
  };
  EXPECT_EQ(at(0, 1), Vec3f(1, 0, 0));
  EXPECT_EQ(at(-7, 9), Vec3f(1, 0, 0));
  EXPECT_EQ(at(7, -9), Vec3f(0, 0, 0));
  EXPECT_EQ(at(0.5, 2), Vec3f(0.5f, 0.5f, 0));
}

TEST(Texture, codes_and_their_values_go_round) {
  for (const TexelEncoding encoding : {TexelEncoding::srgb, TexelEncoding::linear}) {
    for (int code = 0; code < 256; ++code) {
      EXPECT_EQ(encode(encoding, decode_table(encoding)[static_cast<size_t>(code)]), code);
    }
    EXPECT_EQ(encode(encoding, -1), 0);
    EXPECT_EQ(encode(encoding, 2), 255);
  }
}

TEST(Texture, the_srgb_table_is_the_curve_rounded) {
  for (int code = 11; code < 256; ++code) {
    const double value = std::pow((code / 255.0 + 0.055) / 1.055, 2.4);
    EXPECT_FLOAT_EQ(decode_table(TexelEncoding::srgb)[static_cast<size_t>(code)],
                    static_cast<float>(value));
  }
}

TEST(Texture, exr_files_keep_their_radiance) {
  const Image image{
      .size_px = {3, 2},
      .pixels = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {0.5f, 0, 70000}, {0, 0, 0}, {1e-3f, 1, 1}}};
  const Texture texture = load("t.exr", encode_exr(image, {}, {}));
  ASSERT_EQ(texture.width, 3);
  ASSERT_EQ(texture.height, 2);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(color_at(texture, i % 3, i / 3), image.pixels[static_cast<size_t>(i)]);
  }
}

TEST(Texture, damaged_exr_files_are_errors_in_words) {
  const Image image{.size_px = {64, 64}, .pixels = std::vector<Vec3f>(64 * 64, Vec3f(0.3f))};
  const std::string whole = encode_exr(image, {}, {});
  for (const size_t size : {size_t{4}, size_t{20}, whole.size() / 2, whole.size() - 1}) {
    EXPECT_NE(load_error(whole.substr(0, size)).find("no image that can be read"),
              std::string::npos)
        << size;
  }
}

TEST(Texture, heights_become_the_normals_of_their_slopes) {
  std::vector<Vec3f> flat(16, Vec3f(0.5f));
  const Texture level = normals_of_heights(make_texture(4, 4, flat));
  EXPECT_EQ(level.codes[0], 128);
  EXPECT_EQ(level.codes[1], 128);
  EXPECT_EQ(level.codes[2], 255);
  std::vector<Vec3f> ridge(16, Vec3f(0));
  for (size_t row = 0; row < 4; ++row) ridge[4 * row + 2] = Vec3f(1);
  const Texture slopes = normals_of_heights(make_texture(4, 4, ridge));
  // Rising to the right, the normal leans left; past the ridge, right.
  EXPECT_LT(slopes.codes[3 * 1], 128);
  EXPECT_GT(slopes.codes[3 * 3], 128);
  EXPECT_EQ(slopes.codes[3 * 1 + 1], 128);
}

TEST(Texture, the_checker_is_seen) {
  const Texture checker = make_checker();
  EXPECT_GT(color_at(checker, 0, 0).x, 0.5f);
  EXPECT_LT(color_at(checker, 8, 0).x, 0.1f);
}

}  // namespace
}  // namespace tracer
