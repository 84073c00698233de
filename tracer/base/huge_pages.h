// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace tracer {

/// Asks for large pages behind memory that is allocated and not yet written: filling it then takes
/// a fraction of the time. Never fails: where there are none, nothing changes.
void prefer_huge_pages(void* memory, size_t size_bytes);

}  // namespace tracer
