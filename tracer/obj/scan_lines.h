// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/obj/chunk_content.h"

namespace tracer {

/// A line's begin and its number.
struct LinePlace {
  const char* at;
  uint32_t line;
};

/// What goes on from line to line.
struct LineScan {
  ChunkContent& content;
  LargestIndices& largest;
  CornerForm& form;       // of the last face
  uint32_t material = 0;  // in force
};

/// Adds what the lines say, vertices and faces as exporters write them, up to the first that is of
/// another form, or faulty, or no such element: its place, or that of `end`.
LinePlace scan_lines(LinePlace from, const char* end, LineScan& scan);

}  // namespace tracer
