// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace tracer {

enum class Priority { background, idle };

/// From here on the calling thread, and the threads it starts, give way to those of a higher
/// priority where there are fewer processors than threads: background to normal ones, idle to both.
/// Cannot be raised again. Does nothing where the system has no such notion of a thread.
void lower_priority(Priority priority);

/// Runs f() on a thread of its own that gives way to all others, and waits for it. What f throws
/// is thrown here.
void run_at_low_priority(const std::function<void()>& f);

}  // namespace tracer
