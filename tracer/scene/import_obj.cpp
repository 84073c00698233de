// SPDX-License-Identifier: MIT
#include "tracer/scene/import_obj.h"

#include "tracer/base/byte_source.h"
#include "tracer/obj/make_mesh.h"
#include "tracer/scene/import_materials.h"

namespace tracer {
namespace {

struct ReadObj {
  ObjFile file;
  uint64_t byte_count = 0;
};

/// The source is closed before the mesh is made.
ReadObj read_obj(const std::filesystem::path& path, const std::string& name, Texcoords texcoords,
                 Progress& progress) {
  progress.start_stage("reading");
  const auto source = open_byte_source(path, progress);
  ObjFile file = parse_obj(*source, name, progress, texcoords);
  if (source->bytes_taken() == 0) {
    throw LoadError({name, 0, "no triangles to show: the file is empty"});
  }
  return {std::move(file), source->bytes_taken()};
}

/// Nearly all files that name no material library at their begin name none: a second look at those
/// that do costs less than texture coordinates nobody needs. Standard input has no second look.
ReadObj read_obj(const std::filesystem::path& path, const std::string& name, Progress& progress) {
  if (is_standard_input(path)) return read_obj(path, name, Texcoords::kept, progress);
  ReadObj read = read_obj(path, name, Texcoords::dropped, progress);
  if (!read.file.lacks_texcoords) return read;
  read = {};
  return read_obj(path, name, Texcoords::kept, progress);
}

/// Textures are of use where there are coordinates to look them up by.
std::vector<bool> find_textured_materials(const Mesh& mesh, size_t material_count) {
  std::vector<bool> is_textured(material_count, false);
  for (size_t i = 0; i < mesh.texcoord_indices.size(); ++i) {
    is_textured[mesh.material_of(static_cast<uint32_t>(i))] = true;
  }
  return is_textured;
}

/// Whether nothing that the file refers to can have a texture.
Texcoords needed_texcoords(const ObjFile& file) {
  return file.material_libraries.empty() ? Texcoords::dropped : Texcoords::kept;
}

}  // namespace

ImportedScene import_obj(const std::filesystem::path& path, Progress& progress) {
  const std::string name = name_of_input(path);
  auto [file, byte_count] = read_obj(path, name, progress);
  ObjMesh made = make_mesh(file, name, progress, needed_texcoords(file));

  ImportedScene result;
  result.has_normals = !made.mesh.normals.empty();
  result.face_count =
      static_cast<uint32_t>(static_cast<int64_t>(file.face_count) - made.dropped_faces);
  result.dropped_faces = file.dropped_faces + made.dropped_faces;
  result.object_count = file.object_count;
  result.group_count = file.group_count;
  result.file_bytes = byte_count;
  result.bounds = made.bounds;

  ImportedMaterials imported = import_materials(
      path, file, find_textured_materials(made.mesh, file.material_names.size()), progress);
  result.warnings = merged_by_line(merged_by_line(file.warnings, made.warnings), imported.warnings);
  result.warnings.append(imported.library_warnings);
  result.files = std::move(imported.files);

  if (imported.textures.empty()) {
    result.dropped_texcoords = file.counts.texcoords;
    made.mesh.texcoords = {};
    made.mesh.texcoord_indices = {};
  }
  Scene scene;
  scene.lights = std::make_shared<const EmissiveTriangles>(
      make_emissive_triangles(made.mesh, imported.materials));
  scene.surfaces = summarize(imported.materials);
  scene.mesh = std::make_shared<const Mesh>(std::move(made.mesh));
  scene.materials = std::make_shared<const std::vector<Material>>(std::move(imported.materials));
  scene.textures = std::make_shared<const std::vector<Texture>>(std::move(imported.textures));
  progress.throw_if_stopped();
  result.scene = with_shading(scene, result.has_normals ? Shading::smooth : Shading::flat);
  return result;
}

}  // namespace tracer
