// SPDX-License-Identifier: MIT
// Rows that stb_image would never come to the end of.
#include "tracer/scene/hdr_runs.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tracer/base/error.h"
#include "tracer/scene/texture.h"

namespace tracer {
namespace {

using namespace std::string_literals;

const std::string row_head = "\2\2\0\10"s;
const std::string repeated = "\x88\x40"s;                  // eight times 0x40
const std::string one_by_one = "\3\1\2\3\x82\4\3\5\6\7"s;  // three, one twice, three
const std::string row = row_head + repeated + one_by_one + repeated + "\x88\x81"s;

std::string hdr(const std::string& size, const std::string& rows) {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + '\n' + rows;
}

TEST(HdrRuns, whole_rows_are_sound_and_read) {
  const std::string bytes = hdr("-Y 2 +X 8", row + row);
  EXPECT_TRUE(has_sound_hdr_runs(bytes));
  const TemporaryFolder folder;
  std::ofstream(folder / "a.hdr", std::ios::binary) << bytes;
  EXPECT_EQ(load_texture(folder / "a.hdr").levels.front().height, 2);
}

TEST(HdrRuns, a_file_cut_anywhere_is_not_sound_and_loading_it_ends) {
  const std::string bytes = hdr("-Y 2 +X 8", row + row);
  const TemporaryFolder folder;
  for (size_t size = hdr("-Y 2 +X 8", "").size(); size < bytes.size(); ++size) {
    EXPECT_FALSE(has_sound_hdr_runs(bytes.substr(0, size))) << size;
    std::ofstream(folder / "a.hdr", std::ios::binary) << bytes.substr(0, size);
    EXPECT_THROW(load_texture(folder / "a.hdr"), LoadError) << size;
  }
}

TEST(HdrRuns, runs_of_no_texels_or_of_more_than_a_row_has_are_not_sound) {
  EXPECT_FALSE(has_sound_hdr_runs(hdr("-Y 1 +X 8", row_head + "\0"s + repeated)));
  EXPECT_FALSE(has_sound_hdr_runs(hdr("-Y 1 +X 8", row_head + "\x89\x40"s)));
  EXPECT_FALSE(has_sound_hdr_runs(hdr("-Y 1 +X 256", "\2\2\1"s)));
}

TEST(HdrRuns, sizes_that_an_int_does_not_hold_are_not_sound) {
  EXPECT_FALSE(has_sound_hdr_runs(hdr("-Y 1 +X 4294967304", row)));
  EXPECT_FALSE(has_sound_hdr_runs(hdr("-Y -1 +X 8", row)));
  EXPECT_FALSE(has_sound_hdr_runs(hdr("+X 8", row)));
}

TEST(HdrRuns, narrow_pictures_and_other_formats_are_not_looked_at) {
  EXPECT_TRUE(has_sound_hdr_runs(hdr("-Y 1 +X 2", "\1\1\1\200"s)));
  EXPECT_TRUE(has_sound_hdr_runs("P5 1 1 255 x"));
  EXPECT_TRUE(has_sound_hdr_runs(""));
}

}  // namespace
}  // namespace tracer
