// SPDX-License-Identifier: MIT
#include "tracer/scene/import_materials.h"

#include <array>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "tracer/base/file_bytes.h"
#include "tracer/obj/parse_mtl.h"
#include "tracer/obj/text_cursor.h"
#include "tracer/scene/import_textures.h"
#include "tracer/scene/map_material.h"

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

/// What a library's texture decides here, and how it is to be read.
struct SlotUse {
  MtlSlot from;
  MapSlot to;
  TextureUse use;
};
// Where two decide the same, the later counts: what is made for physically based materials.
constexpr std::array slot_uses{
    SlotUse{MtlSlot::kd, MapSlot::base_color, TextureUse::colors},
    SlotUse{MtlSlot::ke, MapSlot::emission, TextureUse::colors},
    SlotUse{MtlSlot::d, MapSlot::opacity, TextureUse::numbers},
    SlotUse{MtlSlot::ks, MapSlot::specular, TextureUse::numbers},
    SlotUse{MtlSlot::ns, MapSlot::roughness, TextureUse::numbers},
    SlotUse{MtlSlot::pr, MapSlot::roughness, TextureUse::numbers},
    SlotUse{MtlSlot::pm, MapSlot::metallic, TextureUse::numbers},
    SlotUse{MtlSlot::bump, MapSlot::normal, TextureUse::normals},
    SlotUse{MtlSlot::norm, MapSlot::normal, TextureUse::normals},
};
// Stands for the checker until that has a number.
constexpr uint32_t refused = no_texture - 1;

constexpr std::array unshown_slots{MtlSlot::ps, MtlSlot::disp, MtlSlot::refl};

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
    read_textures();
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
    if (const Definition* definition = find_definition(name.text)) {
      material = map_material(definition->material);
      if (is_textured) add_maps(*definition, material);
    } else if (!name.text.empty()) {
      if (unknown_count_++ == 0) first_unknown_ = name;
    }
    material.name = name.text;
    result_.materials.push_back(std::move(material));
  }

  void add_maps(const Definition& definition, Material& material) {
    for (const SlotUse& use : slot_uses) {
      const MtlMap& map = definition.material.map(use.from);
      if (!map.path.empty()) add_map(definition, use, map, material);
    }
    for (const MtlSlot slot : unshown_slots) {
      const MtlMap& map = definition.material.map(slot);
      const auto place = static_cast<size_t>(slot);
      if (map.path.empty() || warned_slots_[place]) continue;
      warned_slots_[place] = true;
      result_.library_warnings.add(
          {definition.library, map.line,
           std::string(keyword_of(slot)) + ": textures of this kind are not shown"});
    }
  }

  // Textures are numbered as they are asked for until all are read.
  void add_map(const Definition& definition, const SlotUse& use, const MtlMap& map,
               Material& material) {
    MaterialMap lookup = map_lookup(map, use.to);
    const auto path = locate(definition.folder, map.path);
    const std::string keyword(keyword_of(use.from));
    if (!path) {
      result_.library_warnings.add(
          {definition.library, map.line, keyword + ' ' + refusal(map.path)});
      if (use.use != TextureUse::colors) return;
      lookup.texture = refused;
    } else {
      lookup.texture = request_texture(definition, use.use, *path, map.line, keyword);
    }
    if (use.to == MapSlot::normal) material.normal_strength = map.bump_strength;
    material.set_map(use.to, lookup);
    // Where a texture shines, Ke only tints it, and may be missing.
    if (use.to == MapSlot::emission && material.emission == Vec3f(0)) material.emission = Vec3f(1);
  }

  uint32_t request_texture(const Definition& definition, TextureUse use,
                           const std::filesystem::path& path, int64_t line,
                           const std::string& keyword) {
    const std::filesystem::path full_path = model_folder_ / path;
    if (seen_textures_.insert(full_path.string()).second) result_.files.push_back(full_path);
    return textures_.add({full_path, use, definition.library, line, keyword});
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

  void read_textures() {
    textures_.read(progress_, result_.library_warnings);
    for (Material& material : result_.materials) {
      material.has_maps = false;
      for (size_t i = 0; i < map_slot_count; ++i) {
        const auto slot = static_cast<MapSlot>(i);
        MaterialMap map = material.map(slot);
        if (map.empty()) continue;
        map.texture =
            map.texture == refused ? textures_.checker() : textures_.index_of(map.texture);
        material.set_map(slot, map);
      }
    }
    result_.textures = std::move(textures_.textures());
  }

  const std::string model_path_;
  const std::filesystem::path model_folder_;
  const ObjFile& file_;
  Progress& progress_;
  ImportedMaterials result_;
  std::unordered_map<std::string, bool> seen_libraries_;
  std::unordered_map<std::string, Definition> definitions_;
  std::unordered_set<std::string> seen_textures_;
  std::array<bool, mtl_slot_count> warned_slots_{};
  TextureImporter textures_;
  int64_t unknown_count_ = 0;
  ObjName first_unknown_;
};

}  // namespace

ImportedMaterials import_materials(const std::filesystem::path& model_path, const ObjFile& file,
                                   const std::vector<bool>& is_textured, Progress& progress) {
  return MaterialImporter(model_path, file, progress).import(is_textured);
}

}  // namespace tracer
