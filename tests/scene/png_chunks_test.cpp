// SPDX-License-Identifier: MIT
// Chunks that stb_image would ask for gigabytes for.
#include "tracer/scene/png_chunks.h"

#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tracer/base/error.h"
#include "tracer/scene/texture.h"

namespace tracer {
namespace {

std::string read_corpus_file(const std::string& name) {
  std::ifstream file(BOXWOOD_SOURCE_DIR "/tests/fuzz/corpus/texture/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
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

}  // namespace
}  // namespace tracer
