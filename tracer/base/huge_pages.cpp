// SPDX-License-Identifier: MIT
#include "tracer/base/huge_pages.h"

#ifdef __linux__
#include <cstdint>

#include <sys/mman.h>
#endif

namespace tracer {

void prefer_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] size_t size_bytes) {
#ifdef __linux__
  // Whole huge pages inside only: their neighbours in memory may be someone else's.
  constexpr uintptr_t huge_page = uintptr_t{1} << 21;
  const auto address = reinterpret_cast<uintptr_t>(memory);
  const uintptr_t begin = (address + huge_page - 1) / huge_page * huge_page;
  const uintptr_t end = (address + size_bytes) / huge_page * huge_page;
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

}  // namespace tracer
