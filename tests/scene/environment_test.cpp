// SPDX-License-Identifier: MIT
#include "tracer/scene/environment.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tracer/base/error.h"
#include "tracer/render/image_formats.h"

namespace tracer {
namespace {

/// A Radiance picture of texels (mantissas, exponent).
std::string hdr_of(int width, int height, const std::string& texels) {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
         std::to_string(width) + "\n" + texels;
}

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

class LoadEnvironment : public testing::Test {
 protected:
  std::string error_of(const std::string& name, const std::string& bytes) const {
    try {
      load_environment(folder_.write(name, bytes));
    } catch (const LoadError& error) {
      return error.what();
    }
    return "";
  }
  TemporaryFolder folder_;
};

TEST_F(LoadEnvironment, a_radiance_picture_has_its_values) {
  // 128 * 2^(129 - 136) = 1, 64 * 2^-7 = 0.5, 0.
  const std::string texel("\x80\x40\x00\x81", 4);
  const auto environment =
      load_environment(folder_.write("sky.hdr", hdr_of(4, 2, repeated(texel, 8))));
  EXPECT_EQ(environment->radiance({0, 1, 0}), Vec3d(1, 0.5, 0));
  EXPECT_EQ(environment->map().image().width, 4);
}

TEST_F(LoadEnvironment, an_exr_has_its_values_and_what_is_no_radiance_is_black) {
  Image image{{4, 2}, std::vector<Vec3f>(8, {3, 2, 1})};
  image.pixels[0] = {std::numeric_limits<float>::quiet_NaN(), -1, 5};
  image.pixels[1] = Vec3f(std::numeric_limits<float>::infinity());
  const auto environment = load_environment(folder_.write("sky.exr", encode_exr(image, {}, {})));
  const LatLongImage& loaded = environment->map().image();
  EXPECT_EQ(loaded.texels[0], Vec3f(0, 0, 5));
  EXPECT_EQ(loaded.texels[1], Vec3f(1e30f));
  EXPECT_EQ(loaded.texels[7], Vec3f(3, 2, 1));
}

TEST_F(LoadEnvironment, files_that_are_no_map_are_refused_with_the_reason) {
  const std::string texel("\x80\x40\x00\x81", 4);
  EXPECT_NE(error_of("square.hdr", hdr_of(2, 2, repeated(texel, 4))).find("twice as wide"),
            std::string::npos);
  EXPECT_NE(error_of("text.hdr", "this is no picture").find("neither"), std::string::npos);
  EXPECT_NE(error_of("empty.exr", "").find("neither"), std::string::npos);
  EXPECT_NE(error_of("huge.hdr", hdr_of(2'000'000, 1'000'000, "")).find("too"), std::string::npos);
  // Of a row that ends early stb_image reads for ever.
  const std::string endless("\x02\x02\x00\x10\x00\x00", 6);
  EXPECT_NE(error_of("endless.hdr", hdr_of(16, 8, endless)).find("damaged"), std::string::npos);
  EXPECT_NE(error_of("photo.hdr", "P6 2 1 255\n......").find("neither"), std::string::npos);
  const std::string exr = encode_exr({{4, 2}, std::vector<Vec3f>(8, Vec3f(1))}, {}, {});
  EXPECT_NE(error_of("cut.exr", exr.substr(0, exr.size() / 2)).find("OpenEXR"), std::string::npos);
  EXPECT_THROW(load_environment(folder_ / "missing.hdr"), LoadError);
}

TEST_F(LoadEnvironment, damaged_pictures_throw_or_load_and_never_more) {
  const std::string texel("\x80\x40\x00\x81", 4);
  const std::string hdr = hdr_of(4, 2, repeated(texel, 8));
  const std::string exr = encode_exr({{4, 2}, std::vector<Vec3f>(8, Vec3f(1))}, {}, {});
  for (const std::string& whole : {hdr, exr}) {
    for (size_t i = 0; i < whole.size(); ++i) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ 0x55);
      error_of("damaged", damaged);
      error_of("damaged", whole.substr(0, i));
    }
  }
}

TEST(Environment, the_sun_is_a_disc_that_is_sampled_as_often_as_it_shines) {
  LatLongImage image{8, 4, std::vector<Vec3f>(32, Vec3f(1))};
  const Sun sun{.direction = {0.6, 0.8, 0}, .cos_radius = 0.999, .radiance = Vec3d(5000)};
  const Environment environment(SkyMap(std::move(image)), sun);
  double in_sun = 0, integral = 0;
  constexpr int side = 500;
  for (int i = 0; i < side * side; ++i) {
    const Environment::Sample sample =
        environment.sample({(i % side + 0.5) / side, (i / side + 0.5) / side});
    ASSERT_NEAR(glm::length(sample.direction), 1, 1e-12);
    ASSERT_NEAR(sample.pdf, environment.pdf(sample.direction), 1e-12 * sample.pdf);
    in_sun += sun.covers(sample.direction);
    integral += environment.radiance(sample.direction).x / sample.pdf;
  }
  const double expected = 4 * std::numbers::pi + 5000 * sun.solid_angle();
  EXPECT_NEAR(integral / (side * side) / expected, 1, 1e-2);
  EXPECT_NEAR(in_sun / (side * side), 5000 * sun.solid_angle() / expected, 1e-2);
}

TEST(Environment, a_black_map_leaves_all_samples_to_the_sun) {
  const Sun sun{.direction = {0, 1, 0}, .cos_radius = 0.99, .radiance = Vec3d(1)};
  const Environment environment(SkyMap({4, 2, std::vector<Vec3f>(8, Vec3f(0))}), sun);
  for (const double u : {0.0, 0.5, 0.999}) {
    EXPECT_NEAR(environment.sample({u, u}).pdf, 1 / sun.solid_angle(), 1e-9 / sun.solid_angle());
  }
}

}  // namespace
}  // namespace tracer
