// SPDX-License-Identifier: MIT
#pragma once

namespace tracer {

/// Gives what was freed back to the system, where the allocator keeps it for the next to ask: after
/// work on large arrays that nothing follows. Takes milliseconds.
void give_back_freed_memory();

}  // namespace tracer
