// SPDX-License-Identifier: MIT
#include "tracer/base/huge_pages.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace tracer {
namespace {

constexpr size_t huge_page = size_t{1} << 21;

}  // namespace

void prefer_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] size_t size_bytes) {
#ifdef __linux__
  // Whole huge pages inside only: their neighbours in memory may be someone else's.
  const auto address = reinterpret_cast<uintptr_t>(memory);
  const uintptr_t begin = (address + huge_page - 1) / huge_page * huge_page;
  const uintptr_t end = (address + size_bytes) / huge_page * huge_page;
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

void* allocate_in_huge_pages(size_t size_bytes) {
  const size_t alignment = size_bytes >= 2 * huge_page ? huge_page : 64;
  if (size_bytes > std::numeric_limits<size_t>::max() - alignment) throw std::bad_alloc();
  const size_t rounded = std::max((size_bytes + alignment - 1) / alignment * alignment, alignment);
  void* const memory = std::aligned_alloc(alignment, rounded);
  if (memory == nullptr) throw std::bad_alloc();
  prefer_huge_pages(memory, rounded);
  return memory;
}

}  // namespace tracer
