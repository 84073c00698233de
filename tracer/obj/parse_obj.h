// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/obj/obj_file.h"

namespace tracer {

/// parse_obj, with chunks of about `chunk_bytes` >= 1 in parallel. The result does not depend on
/// it, nor on the number of threads.
ObjFile parse_obj_in_chunks(std::string_view bytes, const std::string& path, size_t chunk_bytes,
                            Progress& progress, Texcoords texcoords = Texcoords::kept);

}  // namespace tracer
