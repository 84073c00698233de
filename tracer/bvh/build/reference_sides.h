// SPDX-License-Identifier: MIT
// Sets of references, looked at and parted by several threads with the result of one.
#pragma once

#include <span>
#include <vector>

#include "tracer/base/parallel.h"
#include "tracer/base/progress.h"
#include "tracer/bvh/build/reference.h"

namespace tracer {

inline constexpr size_t most_chunks = 64;

/// Whether one task does best with the set and all that is made of it.
inline bool is_small(std::span<const Reference> references) {
  return references.size() <= 4096;
}

/// Calls f(chunk, references) for up to `most_chunks` parts of the set, in parallel where there
/// are several.
template <class F>
void for_each_chunk(std::span<const Reference> references, const Progress& progress, F&& f) {
  const size_t size = std::max<size_t>(16384, references.size() / most_chunks + 1);
  const size_t chunk_count = (references.size() + size - 1) / size;
  const auto visit = [&](size_t chunk) {
    progress.throw_if_stopped();
    const size_t begin = chunk * size;
    f(chunk, references.subspan(begin, std::min(size, references.size() - begin)));
  };
  if (chunk_count == 1) return visit(0);
  parallel_for_each_index(0, chunk_count, visit);
}

/// Writes the left side forward from `left` and the right side backward from `right`.
struct SideWriter {
  Reference* left;
  Reference* right;
  SetBounds left_bounds{};
  SetBounds right_bounds{};

  void to_left(const Reference& reference) {
    *left++ = reference;
    left_bounds.extend(reference.box());
  }
  void to_right(const Reference& reference) {
    *--right = reference;
    right_bounds.extend(reference.box());
  }
};

struct SideCounter {
  uint32_t left = 0;
  uint32_t right = 0;

  void to_left(const Reference&) { ++left; }
  void to_right(const Reference&) { ++right; }
};

/// Calls route(reference, sink), which gives what it makes of the reference to either side of the
/// sink, in an order that does not depend on threads. Returns where the sides end and their bounds.
template <class Route>
SideWriter write_sides(std::span<const Reference> references, const SideWriter& start,
                       const Progress& progress, const Route& route) {
  SideWriter all = start;
  if (is_small(references)) {
    for (const Reference& reference : references) route(reference, all);
    return all;
  }
  std::vector<SideCounter> counts(most_chunks);
  for_each_chunk(references, progress, [&](size_t chunk, std::span<const Reference> part) {
    for (const Reference& reference : part) route(reference, counts[chunk]);
  });
  std::vector<SideWriter> writers;
  for (const SideCounter& count : counts) {
    writers.push_back({all.left, all.right});
    all.left += count.left;
    all.right -= count.right;
  }
  for_each_chunk(references, progress, [&](size_t chunk, std::span<const Reference> part) {
    for (const Reference& reference : part) route(reference, writers[chunk]);
  });
  for (const SideWriter& writer : writers) {
    all.left_bounds.extend(writer.left_bounds);
    all.right_bounds.extend(writer.right_bounds);
  }
  return all;
}

}  // namespace tracer
