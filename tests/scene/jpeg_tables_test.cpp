// SPDX-License-Identifier: MIT
// Tables that stb_image would write beyond its arrays for.
#include "tracer/scene/jpeg_tables.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <malloc.h>

#include "tests/support/temporary_folder.h"
#include "tracer/base/error.h"
#include "tracer/scene/texture.h"

namespace tracer {
namespace {

std::string read_corpus_file(const std::string& name) {
  std::ifstream file(BOXWOOD_SOURCE_DIR "/tests/fuzz/corpus/texture/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// A table of 16 * `codes_a_length` codes, where a JPEG's first one begins.
std::string with_table(std::string jpeg, char codes_a_length) {
  const size_t codes = 16 * static_cast<size_t>(static_cast<unsigned char>(codes_a_length));
  const size_t length = 2 + 1 + 16 + codes;
  std::string segment = "\xff\xc4";
  segment += static_cast<char>(length >> 8);
  segment += static_cast<char>(length & 255);
  segment += '\0' + std::string(16, codes_a_length) + std::string(codes, '\1');
  return jpeg.insert(jpeg.find("\xff\xc4"), segment);
}

TEST(JpegTables, real_pictures_are_sound) {
  for (const char* name : {"baseline.jpg", "progressive.jpg"}) {
    const std::string jpeg = read_corpus_file(name);
    ASSERT_FALSE(jpeg.empty());
    EXPECT_TRUE(has_sound_huffman_tables(jpeg)) << name;
  }
}

TEST(JpegTables, what_is_no_jpeg_is_sound) {
  EXPECT_TRUE(has_sound_huffman_tables(""));
  EXPECT_TRUE(has_sound_huffman_tables("\xff"));
  EXPECT_TRUE(has_sound_huffman_tables(read_corpus_file("rgb.png")));
  EXPECT_TRUE(has_sound_huffman_tables(std::string(1000, '\xc4')));
}

TEST(JpegTables, a_table_of_256_codes_is_sound_and_of_more_is_not) {
  const std::string jpeg = read_corpus_file("baseline.jpg");
  EXPECT_TRUE(has_sound_huffman_tables(with_table(jpeg, 16)));
  EXPECT_FALSE(has_sound_huffman_tables(with_table(jpeg, 17)));
  EXPECT_FALSE(has_sound_huffman_tables(with_table(jpeg, '\xff')));
}

TEST(JpegTables, a_faulty_table_between_scans_is_found) {
  const std::string jpeg = read_corpus_file("progressive.jpg");
  const std::string faulty = with_table("\xff\xc4", 17);
  EXPECT_FALSE(has_sound_huffman_tables(jpeg.substr(0, jpeg.size() - 2) + faulty));
}

TEST(JpegTables, a_faulty_table_makes_a_texture_an_error_in_words) {
  const TemporaryFolder folder;
  const auto path =
      folder.write("faulty.jpg", with_table(read_corpus_file("baseline.jpg"), '\xff'));
  EXPECT_THROW(load_texture(path), LoadError);
  const auto sound = folder.write("sound.jpg", read_corpus_file("baseline.jpg"));
  EXPECT_EQ(load_texture(sound).width, 16);
}

#ifdef M_PERTURB
/// The picture, or why there is none, read where fresh memory holds these bytes.
std::string read_with_memory_of(unsigned char byte, const std::filesystem::path& path) {
  mallopt(M_PERTURB, 0xff ^ byte);
  std::string outcome;
  try {
    const Texture texture = load_texture(path);
    outcome.assign(texture.codes.begin(), texture.codes.end());
  } catch (const LoadError& error) {
    outcome = error.what();
  }
  mallopt(M_PERTURB, 0);
  return outcome;
}

TEST(JpegTables, what_uses_tables_that_it_never_defined_is_read_alike_whatever_was_in_memory) {
  std::string jpeg = read_corpus_file("baseline.jpg");
  for (size_t at = jpeg.find("\xff\xc4"); at != std::string::npos; at = jpeg.find("\xff\xc4")) {
    const auto byte_at = [&](size_t i) { return static_cast<unsigned char>(jpeg.at(i)); };
    jpeg.erase(at, 2 + size_t{256} * byte_at(at + 2) + byte_at(at + 3));
  }
  const TemporaryFolder folder;
  const auto path = folder.write("undefined.jpg", jpeg);
  const std::string outcome = read_with_memory_of(0, path);
  EXPECT_EQ(read_with_memory_of(0xa5, path), outcome);
  EXPECT_EQ(read_with_memory_of(0xff, path), outcome);
}
#endif

}  // namespace
}  // namespace tracer
