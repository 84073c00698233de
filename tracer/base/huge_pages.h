// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace tracer {

/// Asks for large pages behind memory that is allocated and not yet written: filling it then takes
/// a fraction of the time. Never fails: where there are none, nothing changes.
void prefer_huge_pages(void* memory, size_t size_bytes);

/// At least `size_bytes`, uninitialised, at a multiple of 64, and where that is much in whole large
/// pages; std::free() frees it. Throws std::bad_alloc.
void* allocate_in_huge_pages(size_t size_bytes);

}  // namespace tracer
