// SPDX-License-Identifier: MIT
#include "tracer/base/file_bytes.h"

#include <thread>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tracer/base/error.h"

namespace tracer {
namespace {

// Over several pieces, the last of them not whole.
std::string pattern() {
  std::string bytes(20'000'001, '\0');
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 7 + i / 251);
  return bytes;
}

std::string error_of(const std::filesystem::path& path) {
  try {
    const FileBytes file(path);
  } catch (const LoadError& error) {
    return error.what();
  }
  return "no error";
}

TEST(FileBytes, holds_every_byte_of_a_file_of_any_size) {
  const TemporaryFolder folder;
  for (const std::string& bytes : {std::string(), std::string("a\0b", 3), pattern()}) {
    const FileBytes file(folder.write("x", bytes));
    EXPECT_TRUE(file.bytes() == bytes) << bytes.size();
  }
}

TEST(FileBytes, stays_as_read_when_the_file_shrinks_afterwards) {
  const TemporaryFolder folder;
  const std::string bytes = pattern();
  const auto path = folder.write("x", bytes);
  const FileBytes file(path);
  std::filesystem::resize_file(path, 0);
  EXPECT_TRUE(file.bytes() == bytes);
}

TEST(FileBytes, a_file_that_ends_early_is_told) {
  // The kernel says 4096 bytes of these, and gives fewer.
  const std::filesystem::path short_file = "/sys/kernel/mm/transparent_hugepage/enabled";
  if (!std::filesystem::exists(short_file)) GTEST_SKIP() << short_file << " is missing";
  EXPECT_EQ(error_of(short_file), short_file.string() + ": the file changed while it was read");
}

TEST(FileBytes, a_file_that_shrinks_while_it_is_read_is_told_or_read_whole) {
  const TemporaryFolder folder;
  const std::string bytes = pattern();
  for (int i = 0; i < 20; ++i) {
    const auto path = folder.write("x", bytes);
    std::thread other([&] {
      std::this_thread::sleep_for(std::chrono::microseconds(200 * i));
      std::filesystem::resize_file(path, bytes.size() / 2);
    });
    try {
      const FileBytes file(path);
      const std::string_view whole_or_half = file.bytes();
      EXPECT_TRUE(whole_or_half == std::string_view(bytes).substr(0, whole_or_half.size()));
    } catch (const LoadError& error) {
      EXPECT_EQ(error.what(), path.string() + ": the file changed while it was read");
    }
    other.join();
  }
}

TEST(FileBytes, a_stop_ends_it) {
  const TemporaryFolder folder;
  Progress progress;
  progress.request_stop();
  EXPECT_THROW(FileBytes(folder.write("x", "abc"), progress), Cancelled);
}

TEST(FileBytes, what_is_no_file_is_told_in_words) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_of(folder.path()), folder.path().string() + ": this is a directory, not a file");
  EXPECT_EQ(error_of("/dev/null"), "/dev/null: this is not a regular file");
}

}  // namespace
}  // namespace tracer
