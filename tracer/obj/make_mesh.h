// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/geometry/mesh.h"
#include "tracer/geometry/world_bounds.h"
#include "tracer/obj/obj_file.h"

namespace tracer {

struct ObjMesh {
  WorldBounds bounds;         // of the triangles
  Mesh mesh;                  // materials index ObjFile::material_names
  int64_t dropped_faces = 0;  // with coordinates that are not finite, or without area
  Warnings warnings;
};

/// Triangulates (concave polygons by ear clipping in the polygon's own plane), subtracts the
/// centre of the bounds in double and rounds once to float. Lets go of the file's vertices and
/// faces as it goes, and leaves the rest of it. Throws LoadError when no triangle is left,
/// Cancelled when asked to stop.
ObjMesh make_mesh(ObjFile& file, const std::string& path, Progress& progress,
                  Texcoords texcoords = Texcoords::kept);

}  // namespace tracer
