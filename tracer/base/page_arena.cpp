// SPDX-License-Identifier: MIT
#include "tracer/base/page_arena.h"

#include <cstdint>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include "tracer/base/huge_pages.h"

namespace tracer {
namespace {

constexpr size_t huge_page = size_t{1} << 21;
constexpr size_t slab_size = 2 * huge_page;
// A slab of their own would be more than these are worth.
constexpr size_t smallest_in_slab = size_t{1} << 14;

size_t round_up(size_t value, size_t multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

#ifdef __linux__
/// Straight from the system, which has it back at once: malloc would keep some of it.
std::shared_ptr<std::byte[]> make_slab(size_t size_bytes) {
  const size_t wanted = size_bytes + huge_page;
  void* const mapped =
      mmap(nullptr, wanted, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  auto* const begin = static_cast<std::byte*>(mapped);
  const auto address = reinterpret_cast<uintptr_t>(begin);
  std::byte* const slab = begin + (round_up(address, huge_page) - address);
  if (slab > begin) munmap(begin, static_cast<size_t>(slab - begin));
  const auto behind = static_cast<size_t>(begin + wanted - (slab + size_bytes));
  if (behind > 0) munmap(slab + size_bytes, behind);
  prefer_huge_pages(slab, size_bytes);
  return {slab, [size_bytes](std::byte* memory) { munmap(memory, size_bytes); }};
}
#else
std::shared_ptr<std::byte[]> make_slab(size_t size_bytes) {
  return {static_cast<std::byte*>(allocate_in_huge_pages(size_bytes)),
          [](std::byte* memory) { std::free(memory); }};
}
#endif

}  // namespace

std::shared_ptr<std::byte[]> PageArena::allocate(size_t size_bytes) {
  if (size_bytes < smallest_in_slab) return std::make_shared<std::byte[]>(size_bytes);
  const size_t size = round_up(size_bytes, 64);
  if (size > slab_size / 2) return make_slab(round_up(size, huge_page));
  const std::lock_guard lock(mutex_);
  if (size > slab_left_) {
    slab_ = make_slab(slab_size);
    next_ = slab_.get();
    slab_left_ = slab_size;
  }
  std::byte* const memory = next_;
  next_ += size;
  slab_left_ -= size;
  return {slab_, memory};
}

}  // namespace tracer
