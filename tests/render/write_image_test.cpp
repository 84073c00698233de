// SPDX-License-Identifier: MIT
#include "tracer/render/write_image.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tracer/base/error.h"
#include "tracer/render/develop.h"
#include "tracer/scene/texture.h"

namespace tracer {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Image make_image(Vec2i size) {
  Image image{size, {}};
  for (int y = 0; y < size.y; ++y) {
    for (int x = 0; x < size.x; ++x) {
      image.pixels.emplace_back(static_cast<float>(x) / static_cast<float>(size.x),
                                static_cast<float>(y) / static_cast<float>(size.y), 0.3f);
    }
  }
  return image;
}

class WriteImage : public testing::Test {
 protected:
  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST_F(WriteImage, pfm_holds_the_bits_from_the_bottom_up) {
  const Image image{{2, 2}, {{1, 2, 3}, {4, 5, 6}, {-0.0f, 1e-40f, 7}, {8, 9, 3.0e38f}}};
  write_image(folder_ / "a.pfm", image, 5);
  const std::string bytes = bytes_of(folder_ / "a.pfm");
  const std::string header = "PF\n2 2\n-1.0\n";
  ASSERT_EQ(bytes.size(), header.size() + 4 * 12);
  EXPECT_EQ(bytes.substr(0, header.size()), header);
  for (size_t row = 0; row < 2; ++row) {
    EXPECT_EQ(std::memcmp(bytes.data() + header.size() + 24 * row,
                          image.pixels.data() + 2 * (1 - row), 24),
              0);
  }
}

TEST_F(WriteImage, exr_holds_the_bits_and_the_metadata) {
  Image image = make_image({37, 11});
  image.pixels[5] = Vec3f(1e-40f, 3e38f, -2);
  const fs::path path = folder_ / "a.exr";
  write_image(path, image, 5, {{"software", "Boxwood"}, {"model", "kuh \xc3\xa4.obj"}});

  Imf::InputFile file(path.c_str());
  EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("software").value(), "Boxwood");
  EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("model").value(),
            "kuh \xc3\xa4.obj");
  ASSERT_EQ(file.header().dataWindow().max.x, 36);
  ASSERT_EQ(file.header().dataWindow().max.y, 10);
  std::vector<Vec3f> pixels(image.pixels.size());
  Imf::FrameBuffer frame;
  const char* names[3] = {"R", "G", "B"};
  for (size_t i = 0; i < 3; ++i) {
    ASSERT_NE(file.header().channels().findChannel(names[i]), nullptr);
    EXPECT_EQ(file.header().channels().findChannel(names[i])->type, Imf::FLOAT);
    frame.insert(names[i], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data()) + 4 * i,
                                      12, static_cast<size_t>(12) * 37));
  }
  file.setFrameBuffer(frame);
  file.readPixels(0, 10);
  EXPECT_EQ(std::memcmp(pixels.data(), image.pixels.data(), 12 * pixels.size()), 0);
}

Vec4f read_texel(const Texture& texture, size_t i) {
  const int place = static_cast<int>(i);
  return texel_at(texture, texture.levels[0], place % texture.width, place / texture.width);
}

TEST_F(WriteImage, png_holds_the_developed_codes_and_the_metadata) {
  const Image image = make_image({37, 11});
  const fs::path path = folder_ / "a.PNG";
  write_image(path, image, 0.5, {{"Software", "Boxwood"}});
  const Texture read = load_texture(path);
  ASSERT_EQ(read.width, 37);
  ASSERT_EQ(read.height, 11);
  std::vector<Rgba8> expected(image.pixels.size());
  develop(image.pixels, 0.5, expected);
  for (size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(encode_srgb(read_texel(read, i).x), expected[i].r);
    ASSERT_EQ(encode_srgb(read_texel(read, i).y), expected[i].g);
    ASSERT_EQ(encode_srgb(read_texel(read, i).z), expected[i].b);
  }
  const std::string bytes = bytes_of(path);
  EXPECT_NE(bytes.find(std::string("iTXtSoftware\0\0\0\0\0Boxwood", 24)), std::string::npos);
  // A checksum known from the standard: that of the chunk that ends every file.
  EXPECT_EQ(bytes.substr(bytes.size() - 8), "IEND\xae\x42\x60\x82");
}

TEST_F(WriteImage, other_extensions_are_refused_with_those_that_are_known) {
  EXPECT_TRUE(is_writable_image("a.EXR"));
  EXPECT_FALSE(is_writable_image("a.jpg"));
  EXPECT_FALSE(is_writable_image("png"));
  try {
    write_image(folder_ / "a.jpg", make_image({1, 1}), 0);
    FAIL();
  } catch (const LoadError& error) {
    EXPECT_EQ(std::string(error.what()),
              (folder_ / "a.jpg").string() + ": pictures are written as .png, .exr or .pfm");
  }
}

TEST_F(WriteImage, a_folder_that_is_missing_is_an_error_and_leaves_nothing) {
  for (const char* name : {"a.png", "a.exr", "a.pfm"}) {
    EXPECT_THROW(write_image(folder_ / "none" / name, make_image({1, 1}), 0), LoadError);
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace tracer
