// SPDX-License-Identifier: MIT
#include "tracer/base/write_file.h"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"
#include "tracer/base/error.h"

namespace tracer {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class WriteFile : public testing::Test {
 protected:
  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST_F(WriteFile, replaces_what_was_there_and_leaves_nothing_beside_it) {
  write_file(folder_ / "a.txt", "first");
  write_file(folder_ / "a.txt", std::string_view("two\0", 4));
  EXPECT_EQ(bytes_of(folder_ / "a.txt"), std::string("two\0", 4));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(WriteFile, refuses_directories_devices_and_missing_folders_in_words) {
  EXPECT_THROW(write_file(folder_, "x"), LoadError);
  EXPECT_THROW(write_file(folder_ / "none" / "a.txt", "x"), LoadError);
  EXPECT_THROW(write_file("/dev/null", "x"), LoadError);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(WriteFile, the_check_refuses_what_writing_would) {
  fs::create_symlink("/dev/null", folder_ / "null.png");
  fs::create_symlink(folder_ / "none" / "a.png", folder_ / "nowhere.png");
  for (const fs::path& path : {folder_, folder_ / "none" / "a.txt", folder_ / "null.png"}) {
    EXPECT_THROW(check_writable(path), LoadError) << path;
    EXPECT_THROW(write_file(path, "x"), LoadError) << path;
  }
  for (const fs::path& path : {folder_ / "a.txt", folder_ / "nowhere.png"}) {
    EXPECT_NO_THROW(check_writable(path)) << path;
    EXPECT_FALSE(fs::exists(path)) << path;
    EXPECT_NO_THROW(write_file(path, "x")) << path;
  }
}

TEST_F(WriteFile, a_writable_file_in_a_folder_that_is_not_is_refused_at_once) {
  if (geteuid() == 0) GTEST_SKIP() << "every folder is writable for root";
  write_file(folder_ / "a.txt", "x");
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(check_writable(folder_ / "a.txt"), LoadError);
  EXPECT_THROW(write_file(folder_ / "a.txt", "y"), LoadError);
  fs::permissions(folder_, fs::perms::owner_all);
}

TEST_F(WriteFile, keeps_a_link_and_replaces_what_it_points_to) {
  write_file(folder_ / "real.txt", "old");
  fs::create_symlink("real.txt", folder_ / "link.txt");
  write_file(folder_ / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(bytes_of(folder_ / "real.txt"), "new");
}

}  // namespace
}  // namespace tracer
