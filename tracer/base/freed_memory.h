// SPDX-License-Identifier: MIT
#pragma once

namespace tracer {

/// From now on the allocator keeps what is freed, some hundred megabytes of it: work that is
/// repeated many times a second then finds memory that the system need not clear again.
void keep_freed_memory();

/// Gives what was freed back to the system, where the allocator keeps it for the next to ask: after
/// work on large arrays that nothing follows. Takes milliseconds.
void give_back_freed_memory();

}  // namespace tracer
