// SPDX-License-Identifier: MIT
// Chunks that stb_image would ask for gigabytes for.
#include "tracer/scene/png_chunks.h"

#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <zlib.h>

#include "tests/support/temporary_folder.h"
#include "tracer/base/error.h"
#include "tracer/scene/texture.h"

namespace tracer {
namespace {

std::string read_corpus_file(const std::string& name) {
  std::ifstream file(BOXWOOD_SOURCE_DIR "/tests/fuzz/corpus/texture/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string big_endian(uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
  return bytes;
}

std::string png_chunk(const std::string& name_and_data) {
  const uLong check = crc32(0, reinterpret_cast<const Bytef*>(name_and_data.data()),
                            static_cast<uInt>(name_and_data.size()));
  return big_endian(static_cast<uint32_t>(name_and_data.size() - 4)) + name_and_data +
         big_endian(static_cast<uint32_t>(check));
}

/// A black pixel whose compressed data are those of `size` zeros.
std::string one_pixel_png(size_t size) {
  const std::string zeros(size, '\0');
  uLongf packed_size = compressBound(static_cast<uLong>(size));
  std::string packed(packed_size, '\0');
  EXPECT_EQ(compress(reinterpret_cast<Bytef*>(packed.data()), &packed_size,
                     reinterpret_cast<const Bytef*>(zeros.data()), static_cast<uLong>(size)),
            Z_OK);
  packed.resize(packed_size);
  const std::string depth_8_rgb("\x08\x02\0\0\0", 5);
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR" + big_endian(1) + big_endian(1) + depth_8_rgb) +
         png_chunk("IDAT" + packed) + png_chunk("IEND");
}

TEST(PngChunks, real_pictures_and_what_is_no_png_are_sound) {
  for (const char* name : {"rgb.png", "rgba.png", "grey16.png", "palette.png", "baseline.jpg"}) {
    const std::string image = read_corpus_file(name);
    ASSERT_FALSE(image.empty());
    EXPECT_TRUE(has_sound_png_chunks(image)) << name;
    EXPECT_TRUE(has_sound_png_chunks(image + "what follows the end")) << name;
  }
  EXPECT_TRUE(has_sound_png_chunks(""));
}

TEST(PngChunks, a_file_that_ends_within_a_chunk_is_damaged) {
  const std::string png = read_corpus_file("rgb.png");
  for (size_t size = 8; size < png.size(); ++size) {
    EXPECT_FALSE(has_sound_png_chunks(png.substr(0, size))) << size;
  }
}

TEST(PngChunks, a_length_of_gigabytes_is_an_error_in_words) {
  const TemporaryFolder folder;
  std::string png = read_corpus_file("rgb.png");
  png[png.find("IDAT") - 4] = '\x3f';
  try {
    load_texture(folder.write("long.png", png));
    ADD_FAILURE() << "it was read";
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("a damaged PNG"), std::string::npos) << error.what();
  }
}

TEST(PngChunks, what_unpacks_to_more_than_its_pixels_is_an_error_in_words_and_takes_no_memory) {
  const TemporaryFolder folder;
  EXPECT_EQ(load_texture(folder.write("pixel.png", one_pixel_png(4))).width, 1);
  try {
    load_texture(folder.write("bomb.png", one_pixel_png(size_t{1} << 26)));
    ADD_FAILURE() << "it was read";
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("it unpacks to more than its pixels"),
              std::string::npos)
        << error.what();
  }
  // The limit was that picture's.
  EXPECT_EQ(load_texture(folder.write("rgb.png", read_corpus_file("rgb.png"))).channel_count, 3);
}

}  // namespace
}  // namespace tracer
