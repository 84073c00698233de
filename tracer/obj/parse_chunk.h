// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/obj/chunk_content.h"
#include "tracer/obj/obj_chunk.h"
#include "tracer/obj/statement_reader.h"

namespace tracer {

/// What a block of text says. Never fails: what is wrong is dropped and said in the warnings.
/// `content` is used meanwhile; the chunk's arrays are in `memory`.
ObjChunk parse_obj_chunk(const TextBlock& block, ChunkContent& content, Texcoords texcoords,
                         ChunkMemory& memory);

}  // namespace tracer
