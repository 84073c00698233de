// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace tracer {

/// Runs f() on a thread of its own that gives way to all others, and waits for it. What f throws
/// is thrown here.
void run_at_low_priority(const std::function<void()>& f);

}  // namespace tracer
