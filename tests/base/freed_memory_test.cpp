// SPDX-License-Identifier: MIT
#include "tracer/base/freed_memory.h"

#include <cstddef>
#include <cstring>
#include <fstream>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

namespace tracer {
namespace {

// Of this process, in memory; 0 where the system does not tell.
size_t resident_bytes() {
  size_t size_pages = 0, resident_pages = 0;
  std::ifstream("/proc/self/statm") >> size_pages >> resident_pages;
  return resident_pages * static_cast<size_t>(sysconf(_SC_PAGESIZE));
}

TEST(FreedMemory, goes_back_to_the_system_though_what_follows_it_is_in_use) {
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "another allocator";
#endif
  if (resident_bytes() == 0) GTEST_SKIP() << "the system does not tell";
  keep_freed_memory();
  constexpr size_t block_bytes = 1024;
  constexpr size_t block_count = size_t{64} * 1024;
  std::vector<std::unique_ptr<char[]>> blocks(block_count);
  for (auto& block : blocks) {
    block = std::make_unique<char[]>(block_bytes);
    std::memset(block.get(), 1, block_bytes);
  }
  const std::unique_ptr<char[]> in_use = std::move(blocks.back());
  const size_t before = resident_bytes();
  blocks.clear();
  give_back_freed_memory();
  EXPECT_LT(resident_bytes() + block_count * block_bytes / 2, before);
  EXPECT_EQ(in_use[0], 1);
}

}  // namespace
}  // namespace tracer
