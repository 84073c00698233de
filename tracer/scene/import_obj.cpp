// SPDX-License-Identifier: MIT
#include "tracer/scene/import_obj.h"

#include "tracer/base/file_bytes.h"
#include "tracer/obj/make_mesh.h"
#include "tracer/scene/import_materials.h"

namespace tracer {
namespace {

struct ReadObj {
  ObjFile file;
  size_t byte_count = 0;
};

/// The text is let go before the mesh is made.
ReadObj read_obj(const std::filesystem::path& path, Progress& progress) {
  progress.start_stage("loading");
  const FileBytes text(path, progress);
  if (text.bytes().empty()) {
    throw LoadError({path.string(), 0, "no triangles to show: the file is empty"});
  }
  return {parse_obj(text.bytes(), path.string(), progress), text.bytes().size()};
}

/// Textures are of use where there are coordinates to look them up by.
std::vector<bool> find_textured_materials(const Mesh& mesh, size_t material_count) {
  std::vector<bool> is_textured(material_count, false);
  for (size_t i = 0; i < mesh.texcoord_indices.size(); ++i) {
    is_textured[mesh.material_of(static_cast<uint32_t>(i))] = true;
  }
  return is_textured;
}

}  // namespace

ImportedScene import_obj(const std::filesystem::path& path, Progress& progress) {
  const std::string name = path.string();
  const auto [file, byte_count] = read_obj(path, progress);
  ObjMesh made = make_mesh(file, name, progress);

  ImportedScene result;
  result.has_normals = !made.mesh.normals.empty();
  result.face_count =
      static_cast<uint32_t>(static_cast<int64_t>(file.faces.size()) - made.dropped_faces);
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

  Scene scene;
  scene.lights = std::make_shared<const EmissiveTriangles>(
      make_emissive_triangles(made.mesh, imported.materials));
  scene.mesh = std::make_shared<const Mesh>(std::move(made.mesh));
  scene.materials = std::make_shared<const std::vector<Material>>(std::move(imported.materials));
  scene.textures = std::make_shared<const std::vector<Texture>>(std::move(imported.textures));
  progress.throw_if_stopped();
  result.scene = with_shading(scene, result.has_normals ? Shading::smooth : Shading::flat);
  return result;
}

}  // namespace tracer
