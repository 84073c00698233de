// SPDX-License-Identifier: MIT
#include "app/render_report.h"

#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/tree_report.h"
#include "tracer/base/error.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;

std::string builder_name(const RenderOptions& options) {
  return options.builder ? std::string(options.builder->name) : "off";
}

double rays_per_second(const RenderReport& report) {
  const double seconds = report.seconds.render;
  return seconds > 0 ? static_cast<double>(report.passes.rays) / seconds : 0;
}

Json to_json(const tracer::Vec3d& v) {
  return Json::array({v.x, v.y, v.z});
}

Json used_settings(const RenderOptions& options, const RenderReport& report) {
  const tracer::Camera& camera = report.view.camera;
  Json settings = {{"size", {report.view.size_px.x, report.view.size_px.y}},
                   {"eye", to_json(camera.eye)},
                   {"target", to_json(camera.target)},
                   {"up", to_json(camera.up)},
                   {"fov", camera.fov_degrees},
                   {"sky", to_json(report.view.sky)},
                   {"integrator", options.integrator->name},
                   {"bvh", builder_name(options)},
                   {"layout", options.layout->name},
                   {"skips", options.render.skips},
                   {"threads", options.thread_count}};
  const EnvironmentSource& environment = report.view.environment;
  if (environment.file) settings["environment"] = environment.file->filename().string();
  if (environment.sun) {
    settings["sun"] = {environment.sun->elevation_degrees, environment.sun->azimuth_degrees};
  }
  const auto add = [&](const auto& value, const auto& field) { settings[field.name] = value; };
  for_each_field(options.build, add);
  for_each_field(options.render, add);
  return settings;
}

Json stats(const RenderOptions& options, const tracer::ImportedScene& imported,
           const RenderReport& report) {
  Json stats = {{"program", "boxwood " BOXWOOD_VERSION},
                {"model", options.model.filename().string()},
                {"triangles", imported.scene.mesh->triangle_count()},
                {"vertices", imported.scene.mesh->positions.size()}};
  add_tree(stats, report.tree, report.tree_quality, report.tree_bytes);
  stats.update({{"seconds",
                 {{"load", report.seconds.load},
                  {"build", report.seconds.build},
                  {"render", report.seconds.render},
                  {"write", report.seconds.write}}},
                {"rays", report.passes.rays},
                {"rays_per_second", rays_per_second(report)},
                {"samples_per_pixel", report.whole_sample_count},
                {"samples", report.passes.samples},
                {"dropped_samples", report.passes.dropped},
                {"dropped_faces", imported.dropped_faces},
                {"warnings", imported.warnings.count()},
                {"settings", used_settings(options, report)}});
  return stats;
}

}  // namespace

std::map<std::string, std::string> picture_metadata(const RenderOptions& options,
                                                    const RenderReport& report) {
  std::map<std::string, std::string> metadata{
      {"Software", "boxwood " BOXWOOD_VERSION},
      {"Model", options.model.filename().string()},
      {"Samples", std::to_string(report.whole_sample_count)},
      {"Seed", std::to_string(options.render.seed)},
      {"Integrator", std::string(options.integrator->name)}};
  if (options.render.clamp > 0) {
    metadata["Clamp"] = fmt::format("indirect light to {}: biased", options.render.clamp);
  }
  return metadata;
}

std::string summary(const RenderOptions& options, const RenderReport& report) {
  return fmt::format("{}: {}x{}, {} {} a pixel, {:.1f} s, {:.2f} Mray/s", options.output->string(),
                     report.view.size_px.x, report.view.size_px.y, report.whole_sample_count,
                     report.whole_sample_count == 1 ? "sample" : "samples", report.seconds.render,
                     rays_per_second(report) * 1e-6);
}

void write_stats(const std::filesystem::path& path, const RenderOptions& options,
                 const tracer::ImportedScene& imported, const RenderReport& report) {
  std::ofstream file(path, std::ios::binary);
  const Json content = stats(options, imported, report);
  file << content.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  file.close();
  if (!file) throw tracer::LoadError({path.string(), 0, "cannot be written"});
}

}  // namespace app
