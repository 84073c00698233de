// SPDX-License-Identifier: MIT
// What must hold for every input; the fuzz targets and the mutation test share it.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tracer/obj/make_mesh.h"
#include "tracer/obj/parse_mtl.h"
#include "tracer/obj/parse_obj.h"

namespace tracer {

/// Ends the process, as fuzzers expect, where `condition` does not hold.
inline void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

template <class T>
void check_indices(const LargeVector<Vec3u>& indices, const LargeVector<T>& values,
                   size_t triangle_count) {
  require(indices.empty() || indices.size() == triangle_count, "indices: one a triangle");
  for (const Vec3u& triple : indices) {
    for (int i = 0; i < 3; ++i) {
      require(triple[i] == no_index || triple[i] < values.size(), "index in range");
    }
  }
}

/// The invariants that Mesh promises.
inline void check_mesh(const Mesh& mesh) {
  require(!mesh.triangles.empty(), "a mesh has triangles");
  require(is_finite(mesh.origin), "origin is finite");
  for (uint32_t i = 0; i < mesh.triangle_count(); ++i) {
    for (int j = 0; j < 3; ++j) {
      require(mesh.triangles[i][j] < mesh.positions.size(), "position index in range");
      require(is_finite(mesh.positions[mesh.triangles[i][j]]), "used positions are finite");
    }
    require(mesh.bounds.contains(mesh.triangle_bounds(i)), "bounds hold every triangle");
  }
  check_indices(mesh.normal_indices, mesh.normals, mesh.triangles.size());
  check_indices(mesh.texcoord_indices, mesh.texcoords, mesh.triangles.size());
  require(mesh.colors.empty() || mesh.colors.size() == mesh.positions.size(), "a color a position");
  require(mesh.materials.empty() || mesh.materials.size() == mesh.triangles.size(),
          "a material a triangle");
}

/// Whatever the chunks, and with or without texture coordinates.
inline void check_same_faces(const ObjFile& a, const ObjFile& b) {
  require(a.face_count == b.face_count, "as many faces");
  require(a.counts.texcoords == b.counts.texcoords, "as many texture coordinates");
  require(a.warnings.count() == b.warnings.count(), "as many warnings");
  for (size_t i = 0; i < a.warnings.messages().size(); ++i) {
    require(a.warnings.messages()[i].text() == b.warnings.messages()[i].text(),
            "the same messages");
  }
}

inline void check_obj(std::string_view bytes) {
  Progress progress;
  ObjFile file = parse_obj(bytes, "x.obj", progress);
  check_same_faces(file, parse_obj_in_chunks(bytes, "x.obj", 16, progress));
  const ObjFile bare = parse_obj_in_chunks(bytes, "x.obj", 16, progress, Texcoords::dropped);
  if (!bare.lacks_texcoords) check_same_faces(file, bare);
  require(file.dropped_faces <= file.warnings.count(), "each dropped face has a warning");
  try {
    const ObjMesh made = make_mesh(file, "x.obj", progress);
    check_mesh(made.mesh);
    for (const uint32_t material : made.mesh.materials) {
      require(material < file.material_names.size(), "material in range");
    }
  } catch (const LoadError&) {
  }
}

inline void check_mtl(std::string_view bytes) {
  for (const MtlMaterial& material : parse_mtl(bytes, "x.mtl").materials) {
    require(is_finite(material.kd) && is_finite(material.ks) && is_finite(material.ke) &&
                std::isfinite(material.ns.value_or(0)) && std::isfinite(material.ni.value_or(0)) &&
                std::isfinite(material.d),
            "material values are finite");
  }
}

}  // namespace tracer
