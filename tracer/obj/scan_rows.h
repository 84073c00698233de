// SPDX-License-Identifier: MIT
// Lines as exporters write them. Each function takes a line behind its keyword and returns where
// the next begins; nullptr, with nothing added, where the line is of a rarer form, or faulty: then
// the parser of parse_chunk.cpp reads it.
#pragma once

#include "tracer/obj/chunk_content.h"

namespace tracer {

/// Past a line's end; `at` stands on it.
inline const char* next_line(const char* at) {
  return at + (at[0] == '\r' && at[1] == '\n' ? 2 : 1);
}

const char* scan_position(const char* at, ChunkContent& content);
const char* scan_texcoord(const char* at, ChunkContent& content);
const char* scan_normal(const char* at, ChunkContent& content);

/// The material in force and the line's number, both as the chunk counts them.
struct FacePlace {
  uint32_t material = 0;
  uint32_t line = 0;
};
/// `form` is what the last face had, and becomes what this one has.
const char* scan_face(const char* at, const FacePlace& place, CornerForm& form,
                      LargestIndices& largest, ChunkContent& content);

}  // namespace tracer
