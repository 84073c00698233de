// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tracer/geometry/mesh.h"
#include "tracer/obj/obj_file.h"

namespace tracer {

/// The triangles of all faces that are not dropped, with what the file says of their corners. Lets
/// go of the file's faces, chunk by chunk. `mesh` holds positions, normals and texture coordinates;
/// of these, those that no triangle uses are emptied. Faces without area, as it is seen after
/// rounding, are dropped: for each chunk's such faces `faults` gets a warning without the path.
void make_triangles(ObjFile& file, Mesh& mesh, std::vector<Warnings>& faults, Progress& progress);

}  // namespace tracer
