// SPDX-License-Identifier: MIT
#include "tracer/obj/make_mesh.h"

#include "tracer/base/parallel.h"
#include "tracer/obj/make_triangles.h"
#include "tracer/obj/mesh_attributes.h"
#include "tracer/obj/used_bounds.h"

namespace tracer {
namespace {

constexpr size_t triangles_a_task = 16384;

Vec3d center_of(const WorldBounds& bounds) {
  return bounds.min.x <= bounds.max.x ? 0.5 * bounds.min + 0.5 * bounds.max : Vec3d(0.0);
}

Box bounds_of_triangles(const Mesh& mesh) {
  std::vector<Box> parts((mesh.triangles.size() + triangles_a_task - 1) / triangles_a_task);
  parallel_for_each_index(0, parts.size(), [&](size_t i) {
    const size_t end = std::min((i + 1) * triangles_a_task, mesh.triangles.size());
    for (size_t j = i * triangles_a_task; j < end; ++j) {
      parts[i].extend(mesh.triangle_bounds(static_cast<uint32_t>(j)));
    }
  });
  Box bounds;
  for (const Box& part : parts) bounds.extend(part);
  return bounds;
}

/// Rounding keeps order: bounds of the rounded positions are the rounded bounds of those in the
/// file.
Box relative_to(const Vec3d& origin, const WorldBounds& bounds) {
  return {Vec3f(bounds.min - origin), Vec3f(bounds.max - origin)};
}

/// Shrinks both bounds to the triangles that are left: in the world, to within rounding.
void shrink_bounds(ObjMesh& made) {
  const Box used = bounds_of_triangles(made.mesh);
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = made.mesh.origin[axis];
    if (used.min[axis] != made.mesh.bounds.min[axis]) {
      made.bounds.min[axis] = origin + static_cast<double>(used.min[axis]);
    }
    if (used.max[axis] != made.mesh.bounds.max[axis]) {
      made.bounds.max[axis] = origin + static_cast<double>(used.max[axis]);
    }
  }
  made.mesh.bounds = used;
}

/// With path and line of the file, each list in the order of its lines.
void add_faults(const ObjFile& file, const std::vector<Warnings>& unusable,
                const std::vector<Warnings>& without_area, const std::string& path, ObjMesh& made) {
  for (size_t i = 0; i < file.chunks.size(); ++i) {
    made.warnings.append_moved(merged_by_line(unusable[i], without_area[i]), path,
                               file.chunks[i].lines_before);
  }
  made.dropped_faces = made.warnings.count();
}

std::string why_nothing_to_show(const ObjFile& file) {
  const std::string nothing = "no triangles to show: ";
  const int64_t face_count = file.dropped_faces + static_cast<int64_t>(file.face_count);
  if (face_count == 1) return nothing + "its only face is faulty";
  if (face_count > 1) return nothing + "all " + std::to_string(face_count) + " faces are faulty";
  if (file.counts.positions > 0) return nothing + "the file has vertices, but no faces";
  return nothing + "this does not look like an OBJ file";
}

/// The first fault says more than that all faces have one.
[[noreturn]] void fail(const ObjFile& file, const Warnings& warnings, const std::string& path) {
  std::string what = why_nothing_to_show(file);
  for (const Warnings* source : {&file.warnings, &warnings}) {
    if (source->messages().empty() || (file.face_count == 0 && file.dropped_faces == 0)) continue;
    const Message& first = source->messages().front();
    what += " (line " + std::to_string(first.line) + ": " + first.what + ')';
    break;
  }
  throw LoadError({path, 0, what});
}

}  // namespace

ObjMesh make_mesh(ObjFile& file, const std::string& path, Progress& progress, Texcoords texcoords) {
  progress.start_stage("making triangles");
  progress.throw_if_stopped();
  ObjMesh made;
  std::vector<Warnings> unusable(file.chunks.size());
  std::vector<Warnings> without_area(file.chunks.size());
  made.bounds = find_used_bounds(file, unusable);
  made.mesh.origin = center_of(made.bounds);
  made.mesh.positions = take_positions(file, made.mesh.origin);
  made.mesh.normals = take_normals(file);
  if (texcoords == Texcoords::kept) {
    made.mesh.texcoords = take_texcoords(file);
  } else {
    drop_texcoords(file);
  }
  made.mesh.colors = take_colors(file);
  progress.throw_if_stopped();
  make_triangles(file, made.mesh, without_area, progress);
  add_faults(file, unusable, without_area, path, made);
  if (made.mesh.triangles.empty()) fail(file, made.warnings, path);
  made.mesh.bounds = relative_to(made.mesh.origin, made.bounds);
  const auto is_any = [](const Warnings& faults) { return faults.count() > 0; };
  if (std::any_of(without_area.begin(), without_area.end(), is_any)) shrink_bounds(made);
  return made;
}

}  // namespace tracer
