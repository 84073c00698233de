// SPDX-License-Identifier: MIT
// Options of the command line whose values are checked as they are read: one line says what a bad
// value is and what would be good.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/environment_source.h"
#include "tracer/base/fields.h"
#include "tracer/base/vectors.h"

namespace app {

/// Bounds of a picture's width and height, and of their product.
inline constexpr int max_side_px = 65535;
inline constexpr int64_t max_picture_px = int64_t{1} << 27;

inline constexpr int max_threads = 1024;

// Throw std::invalid_argument that says what is wanted.
int parse_whole_number(const std::string& text, int min, int max);
double parse_number(const std::string& text, double min, double max);
tracer::Vec3d parse_vec3(const std::string& text);     // "x,y,z"
tracer::Vec3d parse_sky(const std::string& text);      // "r,g,b", each 0 to 1e30
tracer::Vec2i parse_size_px(const std::string& text);  // "1280x720"
tracer::Vec2i parse_pixel(const std::string& text);    // "x,y", none below 0
/// "30,120": degrees above the horizon, 0 to 90, and of azimuth, -360 to 360.
tracer::SunPosition parse_sun(const std::string& text);

/// Calls `read(text)` with the option's value; its std::invalid_argument names the option.
CLI::Option* add_value(CLI::App& app, const std::string& names, const std::string& value_name,
                       const std::string& help, std::function<void(const std::string&)> read);

CLI::Option* add_path(CLI::App& app, const std::string& names, const std::string& value_name,
                      const std::string& help,
                      std::function<void(const std::filesystem::path&)> read);

/// --environment and --sun.
void add_environment(CLI::App& app, EnvironmentSource& environment, const std::string& group);

/// One option for each field of a settings struct.
template <class Settings>
void add_fields(CLI::App& app, const std::string& group, Settings& settings) {
  for_each_field(settings, [&]<class T>(T& value, const tracer::Field<T>& field) {
    const auto read = [&value, min = field.min, max = field.max](const std::string& text) {
      if constexpr (std::is_integral_v<T>) {
        value = parse_whole_number(text, min, max);
      } else {
        value = parse_number(text, min, max);
      }
    };
    add_value(app, fmt::format("--{}", field.name), std::is_integral_v<T> ? "N" : "X",
              fmt::format("{}, {} to {} [{}]", field.help, field.min, field.max, value), read)
        ->group(group);
  });
}

/// The names in a table of named things: "path, ao, normals".
template <class Entry>
std::string names_in(std::span<const Entry> table) {
  std::string names;
  for (const Entry& entry : table) {
    if (!names.empty()) names += ", ";
    names += entry.name;
  }
  return names;
}

/// The entry of that name. Throws std::invalid_argument with the names there are.
template <class Entry>
const Entry* chosen_from(std::span<const Entry> table, const std::string& name) {
  for (const Entry& entry : table) {
    if (entry.name == name) return &entry;
  }
  throw std::invalid_argument(fmt::format("'{}' is none of {}", name, names_in(table)));
}

}  // namespace app
