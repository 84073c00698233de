// SPDX-License-Identifier: MIT
#include "app/replay.h"

#include <fmt/format.h>

namespace app {
namespace {

// The shortest decimals that are read as the same doubles.
std::string text_of(const tracer::Vec3d& v) {
  return fmt::format("{},{},{}", v.x, v.y, v.z);
}

std::string text_of(const tracer::SunPosition& sun) {
  return fmt::format("{},{}", sun.elevation_degrees, sun.azimuth_degrees);
}

std::string quoted(const std::string& argument) {
  const char* const plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./,=+:@%";
  if (!argument.empty() && argument.find_first_not_of(plain) == std::string::npos) return argument;
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + '\'';
}

}  // namespace

std::vector<std::string> replay_arguments(const std::filesystem::path& model,
                                          const ResolvedView& view,
                                          const tracer::Integrator& integrator,
                                          const tracer::RenderSettings& settings,
                                          const tracer::SampleId& id) {
  const tracer::Camera& camera = view.camera;
  std::vector<std::string> arguments{
      "render",
      model.string(),
      fmt::format("--pixel={},{}", id.pixel.x, id.pixel.y),
      fmt::format("--sample={}", id.sample),
      fmt::format("--size={}x{}", view.size_px.x, view.size_px.y),
      "--eye=" + text_of(camera.eye),
      "--target=" + text_of(camera.target),
      "--up=" + text_of(camera.up),
      fmt::format("--fov={}", camera.fov_degrees),
      "--sky=" + text_of(view.sky),
      fmt::format("--integrator={}", integrator.name),
  };
  if (view.environment.file) {
    arguments.push_back("--environment=" + view.environment.file->string());
  }
  if (view.environment.sun) arguments.push_back("--sun=" + text_of(*view.environment.sun));
  for_each_field(settings, [&](const auto& value, const auto& field) {
    arguments.push_back(fmt::format("--{}={}", field.name, value));
  });
  return arguments;
}

std::string count_of_dropped(uint64_t dropped_samples) {
  return dropped_samples == 1
             ? "1 sample was not finite and counts as black"
             : fmt::format("{} samples were not finite and count as black", dropped_samples);
}

std::string replay_command(const std::vector<std::string>& arguments) {
  std::string command = "boxwood";
  for (const std::string& argument : arguments) command += ' ' + quoted(argument);
  return command;
}

}  // namespace app
