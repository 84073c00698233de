// SPDX-License-Identifier: MIT
#include "app/info_command.h"

#include <cstdio>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/exit_code.h"
#include "app/info_trees.h"
#include "app/print_warnings.h"
#include "tracer/scene/import_obj.h"
#include "tracer/scene/profile.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const tracer::Vec3d& v) {
  return Json::array({v.x, v.y, v.z});
}

std::vector<uint32_t> triangles_of_each_material(const tracer::Scene& scene) {
  std::vector<uint32_t> counts(scene.materials->size(), 0);
  for (uint32_t i = 0; i < scene.mesh->triangle_count(); ++i) ++counts[scene.mesh->material_of(i)];
  return counts;
}

Json describe_materials(const tracer::Scene& scene) {
  const std::vector<uint32_t> triangle_counts = triangles_of_each_material(scene);
  Json materials = Json::array();
  for (size_t i = 0; i < scene.materials->size(); ++i) {
    const tracer::Material& material = (*scene.materials)[i];
    materials.push_back({{"name", material.name},
                         {"used", triangle_counts[i] > 0},
                         {"triangles", triangle_counts[i]},
                         {"diffuse", to_json(tracer::Vec3d(material.scattering.base_color))},
                         {"emission", to_json(tracer::Vec3d(material.emission))},
                         {"textured", material.has_maps}});
  }
  return materials;
}

Json describe_skips(const tracer::ImportedScene& imported) {
  Json skips = Json::array();
  for (const auto& [what, why] : tracer::skipped_work(tracer::make_profile(imported.scene))) {
    skips.push_back({{"what", what}, {"why", why}});
  }
  if (imported.dropped_texcoords > 0) {
    skips.push_back({{"what", fmt::format("{} texture coordinates", imported.dropped_texcoords)},
                     {"why", "no used material has a texture"}});
  }
  return skips;
}

// All there is to say, once: the table is made from it too.
Json describe(const std::filesystem::path& path, const tracer::ImportedScene& imported) {
  const tracer::Mesh& mesh = *imported.scene.mesh;
  Json messages = Json::array();
  for (const tracer::Message& message : imported.warnings.messages()) {
    messages.push_back(message.text());
  }
  return {
      {"file", path.filename().string()},
      {"bytes", imported.file_bytes},
      {"triangles", mesh.triangle_count()},
      {"vertices", mesh.positions.size()},
      {"faces", imported.face_count},
      {"objects", imported.object_count},
      {"groups", imported.group_count},
      {"textures", imported.scene.textures->size()},
      {"lights", imported.scene.lights->triangles.size()},
      {"normals", imported.has_normals},
      {"texture_coordinates", !mesh.texcoords.empty()},
      {"colors", !mesh.colors.empty()},
      {"bounds", {{"min", to_json(imported.bounds.min)}, {"max", to_json(imported.bounds.max)}}},
      {"origin", to_json(mesh.origin)},
      {"materials", describe_materials(imported.scene)},
      {"skipped", describe_skips(imported)},
      {"dropped_faces", imported.dropped_faces},
      {"warnings", {{"count", imported.warnings.count()}, {"messages", messages}}}};
}

std::string numbers(const Json& vector) {
  return fmt::format("{:.10g}  {:.10g}  {:.10g}", vector[0].get<double>(), vector[1].get<double>(),
                     vector[2].get<double>());
}

void print_row(const char* label, const std::string& value) {
  fmt::print("  {:<14} {}\n", label, value);
}

std::string yes_no(const Json& value) {
  return value.get<bool>() ? "yes" : "no";
}

void print_materials(const Json& materials) {
  fmt::print("  {:<14} {}\n", "materials", materials.size());
  for (const Json& material : materials) {
    const std::string name = material["name"].get<std::string>();
    const auto triangles = material["triangles"].get<uint32_t>();
    fmt::print("    {:<24} {}{}\n", name.empty() ? "(none named)" : name,
               triangles > 0 ? fmt::format("{} triangles", triangles) : "not used",
               material["textured"].get<bool>() ? ", textured" : "");
  }
}

void print_skips(const Json& skips) {
  const char* label = "skipped";
  for (const Json& skip : skips) {
    print_row(label, fmt::format("{}: {}", skip["what"].get<std::string>(),
                                 skip["why"].get<std::string>()));
    label = "";
  }
}

void print_table(const Json& info) {
  fmt::print("{}\n", info["file"].get<std::string>());
  for (const char* key : {"bytes", "triangles", "vertices", "faces", "objects", "groups"}) {
    print_row(key, info[key].dump());
  }
  print_row("normals", yes_no(info["normals"]));
  print_row("texture coord.", yes_no(info["texture_coordinates"]));
  print_row("vertex colors", yes_no(info["colors"]));
  print_row("textures", info["textures"].dump());
  print_row("lights", info["lights"].dump() + " emissive triangles");
  print_row("from", numbers(info["bounds"]["min"]));
  print_row("to", numbers(info["bounds"]["max"]));
  print_row("origin", numbers(info["origin"]));
  print_materials(info["materials"]);
  print_skips(info["skipped"]);
  print_row("faces left out", info["dropped_faces"].dump());
  print_row("warnings", info["warnings"]["count"].dump());
  print_trees(info["trees"]);
}

}  // namespace

int info_command(const InfoOptions& options) {
  tracer::Progress progress;
  const tracer::ImportedScene imported = tracer::import_obj(options.model, progress);
  Json info = describe(options.model, imported);
  info["trees"] = describe_trees(imported.scene.mesh, options.builders, options.build);
  if (options.format == InfoOptions::Format::json) {
    // A name in the file need not be UTF-8; what is not is replaced.
    fmt::print("{}\n", info.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    print_warnings(options.model, imported);
    print_table(info);
  }
  return exit_code::success;
}

}  // namespace app
