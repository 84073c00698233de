// SPDX-License-Identifier: MIT
#pragma once

#include "tracer/geometry/mesh.h"
#include "tracer/obj/obj_file.h"

namespace tracer {

/// Each of these lets go of what it takes from the chunks, piece by piece.

/// Relative to `origin`. Positions that no float can hold become 0.
LargeVector<Vec3f> take_positions(ObjFile& file, const Vec3d& origin);
/// Unit length, or 0 where one has no direction.
LargeVector<Vec3f> take_normals(ObjFile& file);
LargeVector<Vec2f> take_texcoords(ObjFile& file);
void drop_texcoords(ObjFile& file);
/// From 0 to 1; a vertex without a colour is white. Empty where no vertex has one.
LargeVector<Vec3f> take_colors(ObjFile& file);

}  // namespace tracer
