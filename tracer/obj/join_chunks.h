// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <string>

#include "tracer/obj/obj_chunk.h"
#include "tracer/obj/obj_file.h"

namespace tracer {

/// One file from its chunks in order: indices resolved and checked against the whole file, faces
/// that name missing vertices dropped, lines and materials counted from the file's start.
ObjFile join_chunks(std::deque<ObjChunk> chunks, const std::string& path, Progress& progress);

}  // namespace tracer
