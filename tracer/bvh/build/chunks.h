// SPDX-License-Identifier: MIT
// Parallel passes over ranges of primitives, in chunks that do not depend on the threads.
#pragma once

#include <algorithm>
#include <atomic>

#include "tracer/base/parallel.h"
#include "tracer/base/progress.h"
#include "tracer/bvh/build/subdivide.h"

namespace tracer {

inline constexpr uint32_t chunk_size = 32768;

inline uint32_t chunk_count(PrimitiveRange range) {
  return (range.count() + chunk_size - 1) / chunk_size;
}

inline PrimitiveRange chunk_of(PrimitiveRange range, uint32_t chunk) {
  const uint32_t begin = range.begin + chunk * chunk_size;
  return {begin, begin + std::min(chunk_size, range.end - begin)};
}

/// Calls f(chunk, chunk_of(range, chunk)) for each chunk, in parallel where there are several.
/// Throws Cancelled unless all was done.
template <class F>
void for_each_chunk(PrimitiveRange range, const Progress& progress, F&& f) {
  const uint32_t count = chunk_count(range);
  if (count == 1) return f(0u, range);
  std::atomic<uint32_t> done_count{0};
  parallel_for_each_index(0, count, [&](size_t i) {
    progress.throw_if_stopped();
    const auto chunk = static_cast<uint32_t>(i);
    f(chunk, chunk_of(range, chunk));
    ++done_count;
  });
  // Tasks are skipped, without an exception here, once one elsewhere has thrown.
  if (done_count != count) throw Cancelled{};
}

}  // namespace tracer
