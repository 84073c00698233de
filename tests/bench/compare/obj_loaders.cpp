// SPDX-License-Identifier: MIT
#include "tests/bench/compare/obj_loaders.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "tests/bench/compare/pinned_threads.h"
#include "tracer/scene/import_obj.h"

#ifdef BOXWOOD_TINYOBJLOADER
#include <tiny_obj_loader.h>
#endif
#ifdef BOXWOOD_ASSIMP
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#endif

namespace bench {
namespace {

using tracer::Vec3f;

template <class Array>
size_t bytes_of(const Array& array) {
  return array.size() * sizeof array[0];
}

size_t bytes_of_mesh(const tracer::Mesh& mesh) {
  return bytes_of(mesh.positions) + bytes_of(mesh.triangles) + bytes_of(mesh.normals) +
         bytes_of(mesh.normal_indices) + bytes_of(mesh.texcoords) +
         bytes_of(mesh.texcoord_indices) + bytes_of(mesh.colors) + bytes_of(mesh.materials);
}

LoadedModel load_ours(const std::filesystem::path& path) {
  tracer::Progress progress;
  std::shared_ptr<const tracer::Mesh> mesh = tracer::import_obj(path, progress).scene.mesh;
  LoadedModel model;
  model.triangle_count = mesh->triangle_count();
  model.bytes = bytes_of_mesh(*mesh);
  model.origin = mesh->origin;
  model.corner = [mesh = std::move(mesh)](uint64_t triangle, int corner) {
    return mesh->positions[mesh->triangles[triangle][corner]];
  };
  return model;
}

#ifdef BOXWOOD_TINYOBJLOADER
struct TinyObj {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
};

LoadedModel load_tinyobj(const std::filesystem::path& path) {
  const auto file = std::make_shared<TinyObj>();
  std::vector<tinyobj::material_t> materials;
  std::string warnings, errors;
  const std::string folder = path.parent_path().string() + '/';
  if (!tinyobj::LoadObj(&file->attributes, &file->shapes, &materials, &warnings, &errors,
                        path.c_str(), folder.c_str()) ||
      file->shapes.size() != 1) {
    throw std::runtime_error("tinyobjloader: cannot load " + path.string() + ' ' + errors);
  }
  LoadedModel model;
  model.triangle_count = file->shapes[0].mesh.indices.size() / 3;
  model.corner = [file](uint64_t triangle, int corner) {
    const auto& index = file->shapes[0].mesh.indices[3 * triangle + static_cast<uint64_t>(corner)];
    const float* const position =
        file->attributes.vertices.data() + 3 * static_cast<size_t>(index.vertex_index);
    return Vec3f(position[0], position[1], position[2]);
  };
  return model;
}
#endif

#ifdef BOXWOOD_ASSIMP
LoadedModel load_assimp(const std::filesystem::path& path) {
  const auto importer = std::make_shared<Assimp::Importer>();
  const aiScene* const scene = importer->ReadFile(path.string(), aiProcess_Triangulate);
  if (scene == nullptr || scene->mNumMeshes != 1) {
    throw std::runtime_error("assimp: cannot load " + path.string());
  }
  LoadedModel model;
  const aiMesh* const mesh = scene->mMeshes[0];
  model.triangle_count = mesh->mNumFaces;
  model.corner = [importer, mesh](uint64_t triangle, int corner) {
    const aiVector3D& position = mesh->mVertices[mesh->mFaces[triangle].mIndices[corner]];
    return Vec3f(position.x, position.y, position.z);
  };
  return model;
}
#endif

std::vector<ObjLoader> find_loaders() {
  std::vector<ObjLoader> all{{"boxwood", processor_count(), load_ours}};
#ifdef BOXWOOD_TINYOBJLOADER
  all.push_back({"tinyobjloader", 1, load_tinyobj});
#endif
#ifdef BOXWOOD_ASSIMP
  all.push_back({"assimp", 1, load_assimp});
#endif
  return all;
}

}  // namespace

const std::vector<ObjLoader>& obj_loaders() {
  static const std::vector<ObjLoader> all = find_loaders();
  return all;
}

std::vector<std::string> missing_obj_loaders() {
  std::vector<std::string> missing;
  for (const auto& [name, package] :
       {std::pair{"tinyobjloader", "libtinyobjloader-dev"}, std::pair{"assimp", "libassimp-dev"}}) {
    if (std::ranges::find(obj_loaders(), name, &ObjLoader::name) == obj_loaders().end()) {
      missing.push_back(std::string(name) + " (" + package + ')');
    }
  }
  return missing;
}

}  // namespace bench
