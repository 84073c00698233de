// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/obj/obj_chunk.h"

namespace tracer {

/// Makes all indices of a chunk count from the file's begin, where `before` stands in the file
/// before the chunk and `total` in all of it. A face that names a missing position is dropped: its
/// first index becomes 0; a missing attribute becomes 0. Both are warnings, which are returned.
Warnings check_faces(ObjChunk& chunk, const ObjCounts& before, const ObjCounts& total);

}  // namespace tracer
