// SPDX-License-Identifier: MIT
#include "tracer/scene/import_materials.h"

#include <optional>
#include <unordered_map>
#include <utility>

#include "tracer/base/file_bytes.h"
#include "tracer/base/parallel.h"
#include "tracer/obj/parse_mtl.h"
#include "tracer/obj/text_cursor.h"

namespace tracer {
namespace {

/// `written`, found in `folder`, as a path relative to the model's folder; nullopt where it is
/// absolute or climbs out of there.
std::optional<std::filesystem::path> resolve_path(const std::filesystem::path& folder,
                                                  std::string written) {
  std::replace(written.begin(), written.end(), '\\', '/');
  const bool has_drive = written.size() > 1 && written[1] == ':';
  if (written.empty() || has_drive || written.find('\0') != written.npos) return std::nullopt;
  const std::filesystem::path path(written);
  if (path.is_absolute()) return std::nullopt;
  std::filesystem::path resolved = (folder / path).lexically_normal();
  if (*resolved.begin() == "..") return std::nullopt;
  return resolved;
}

/// What stands behind the last separator.
std::string file_name_of(const std::string& written) {
  return written.substr(written.find_last_of("/\\:") + 1);
}

std::string refusal(const std::string& written) {
  return quote_text(written) + " is refused: paths must stay in the model's folder, and " +
         quote_text(file_name_of(written)) + " is not there";
}

/// A texture that a material asks for, and where it asks.
struct TextureRequest {
  std::filesystem::path path;
  std::string library;
  int64_t line = 0;
};

struct DecodedTexture {
  Texture texture;
  std::optional<std::string> fault;
};

class MaterialImporter {
 public:
  MaterialImporter(const std::filesystem::path& model_path, const ObjFile& file, Progress& progress)
      : model_path_(model_path.string()),
        model_folder_(model_path.parent_path()),
        file_(file),
        progress_(progress) {}

  ImportedMaterials import(const std::vector<bool>& is_textured) {
    progress_.start_stage("reading materials");
    for (const ObjName& name : file_.material_libraries) add_library(name);
    for (size_t i = 0; i < file_.material_names.size(); ++i) {
      add_material(file_.material_names[i], is_textured[i]);
    }
    warn_of_unknown();
    decode_textures();
    return std::move(result_);
  }

 private:
  struct Definition {
    MtlMaterial material;
    std::filesystem::path folder;  // of its library, relative to the model's
    std::string library;
  };

  /// Where `written`, found in `folder`, is to be read: exporters write paths of their own machine,
  /// so that a file of its name in `folder` stands in for one that is refused or missing.
  std::optional<std::filesystem::path> locate(const std::filesystem::path& folder,
                                              const std::string& written) const {
    auto named = resolve_path(folder, written);
    if (named && is_file(*named)) return named;
    auto beside = resolve_path(folder, file_name_of(written));
    if (beside && is_file(*beside)) return beside;
    return named;
  }

  bool is_file(const std::filesystem::path& path) const {
    std::error_code ignored;
    return std::filesystem::is_regular_file(model_folder_ / path, ignored);
  }

  void warn(int64_t line, const std::string& what) {
    result_.warnings.add({model_path_, line, what});
  }

  void add_library(const ObjName& name) {
    const auto path = locate({}, name.text);
    if (!path) return warn(name.line, "material library " + refusal(name.text));
    if (!seen_libraries_.try_emplace(path->string(), true).second) return;
    progress_.throw_if_stopped();
    const std::string full_path = (model_folder_ / *path).string();
    result_.files.emplace_back(full_path);
    try {
      const FileBytes text(full_path);
      MtlFile parsed = parse_mtl(text.bytes(), full_path);
      result_.library_warnings.append(parsed.warnings);
      for (MtlMaterial& material : parsed.materials) {
        std::string key = material.name;
        definitions_.try_emplace(std::move(key),
                                 Definition{std::move(material), path->parent_path(), full_path});
      }
    } catch (const LoadError& error) {
      warn(name.line, std::string("material library: ") + error.what());
    }
  }

  /// The name as written, else without what may be a comment: both "Material #2" and
  /// "red #comment" exist.
  const Definition* find_definition(const std::string& name) const {
    auto found = definitions_.find(name);
    if (found == definitions_.end()) found = definitions_.find(name.substr(0, name.find(" #")));
    return found == definitions_.end() ? nullptr : &found->second;
  }

  void add_material(const ObjName& name, bool is_textured) {
    Material material;
    material.name = name.text;
    if (const Definition* definition = find_definition(name.text)) {
      copy_values(definition->material, material);
      if (is_textured && !definition->material.map_kd.empty()) {
        material.diffuse_texture = request_texture(*definition);
      }
    } else if (!name.text.empty()) {
      if (unknown_count_++ == 0) first_unknown_ = name;
    }
    result_.materials.push_back(std::move(material));
  }

  static void copy_values(const MtlMaterial& from, Material& to) {
    to.scattering.base_color = glm::clamp(from.kd, 0.0f, 1.0f);
    to.emission = glm::max(from.ke, 0.0f);
    to.specular = glm::clamp(from.ks, 0.0f, 1.0f);
    to.shininess = std::max(from.ns, 0.0f);
    to.ior = from.ni;
    to.opacity = std::clamp(from.d, 0.0f, 1.0f);
    to.illum = from.illum;
  }

  uint32_t request_texture(const Definition& definition) {
    const std::string& written = definition.material.map_kd;
    const int64_t line = definition.material.map_kd_line;
    const auto path = locate(definition.folder, written);
    if (!path) {
      result_.library_warnings.add({definition.library, line, "map_Kd " + refusal(written)});
      return no_texture;
    }
    const auto next = static_cast<uint32_t>(requests_.size());
    const auto [entry, is_new] = request_indices_.try_emplace(path->string(), next);
    if (is_new) {
      requests_.push_back({model_folder_ / *path, definition.library, line});
      result_.files.push_back(requests_.back().path);
    }
    return entry->second;
  }

  void warn_of_unknown() {
    if (unknown_count_ == 0) return;
    std::string what = "material " + quote_text(first_unknown_.text);
    if (unknown_count_ > 1) what += " and " + std::to_string(unknown_count_ - 1) + " more";
    what += ": in no material library, shown in the default grey";
    Warnings unknown;
    unknown.add({model_path_, first_unknown_.line, what});
    result_.warnings = merged_by_line(result_.warnings, unknown);
  }

  void decode_textures() {
    progress_.start_stage("reading textures");
    std::vector<DecodedTexture> decoded(requests_.size());
    std::atomic<size_t> done{0};
    parallel_for_each_index(0, requests_.size(), [&](size_t i) {
      progress_.throw_if_stopped();
      try {
        decoded[i].texture = load_texture(requests_[i].path);
      } catch (const LoadError& error) {
        decoded[i].fault = error.what();
      }
      progress_.set_fraction(static_cast<double>(++done) / static_cast<double>(requests_.size()));
    });
    keep_decoded(decoded);
  }

  /// Textures that cannot be read leave the array, and the materials that name them.
  void keep_decoded(std::vector<DecodedTexture>& decoded) {
    std::vector<uint32_t> kept(decoded.size(), no_texture);
    for (size_t i = 0; i < decoded.size(); ++i) {
      if (decoded[i].fault) {
        result_.library_warnings.add(
            {requests_[i].library, requests_[i].line, "map_Kd: " + *decoded[i].fault});
        continue;
      }
      kept[i] = static_cast<uint32_t>(result_.textures.size());
      result_.textures.push_back(std::move(decoded[i].texture));
    }
    for (Material& material : result_.materials) {
      if (material.diffuse_texture != no_texture) {
        material.diffuse_texture = kept[material.diffuse_texture];
      }
    }
  }

  const std::string model_path_;
  const std::filesystem::path model_folder_;
  const ObjFile& file_;
  Progress& progress_;
  ImportedMaterials result_;
  std::unordered_map<std::string, bool> seen_libraries_;
  std::unordered_map<std::string, Definition> definitions_;
  std::vector<TextureRequest> requests_;
  std::unordered_map<std::string, uint32_t> request_indices_;
  int64_t unknown_count_ = 0;
  ObjName first_unknown_;
};

}  // namespace

ImportedMaterials import_materials(const std::filesystem::path& model_path, const ObjFile& file,
                                   const std::vector<bool>& is_textured, Progress& progress) {
  return MaterialImporter(model_path, file, progress).import(is_textured);
}

}  // namespace tracer
