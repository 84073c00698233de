// SPDX-License-Identifier: MIT
#include "app/option_values.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "tracer/scene/view_file.h"

namespace app {
namespace {

// The whole text as a number, or nothing.
template <class T>
std::optional<T> read_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

[[noreturn]] void fail(const std::string& text, const std::string& wanted) {
  throw std::invalid_argument(fmt::format("'{}' is not {}", text, wanted));
}

// Both numbers of "a<separator>b".
std::optional<tracer::Vec2i> read_pair(std::string_view text, char separator) {
  const size_t middle = text.find(separator);
  if (middle == std::string_view::npos) return std::nullopt;
  const auto first = read_number<int>(text.substr(0, middle));
  const auto second = read_number<int>(text.substr(middle + 1));
  if (!first || !second) return std::nullopt;
  return tracer::Vec2i(*first, *second);
}

}  // namespace

int parse_whole_number(const std::string& text, int min, int max) {
  const auto value = read_number<int>(text);
  if (!value || *value < min || *value > max) {
    fail(text, fmt::format("a whole number from {} to {}", min, max));
  }
  return *value;
}

double parse_number(const std::string& text, double min, double max) {
  const auto value = read_number<double>(text);
  if (!value || !(*value >= min && *value <= max)) {
    fail(text, fmt::format("a number from {} to {}", min, max));
  }
  return *value;
}

tracer::Vec3d parse_vec3(const std::string& text) {
  tracer::Vec3d result;
  std::string_view rest = text;
  for (int axis = 0; axis < 3; ++axis) {
    const size_t end = axis < 2 ? rest.find(',') : rest.size();
    const auto value = read_number<double>(rest.substr(0, end));
    if (end == std::string_view::npos || !value || !std::isfinite(*value)) {
      fail(text, "three numbers such as 1,2.5,-3");
    }
    result[axis] = *value;
    if (axis < 2) rest.remove_prefix(end + 1);
  }
  return result;
}

tracer::Vec3d parse_sky(const std::string& text) {
  const tracer::Vec3d sky = parse_vec3(text);
  if (!tracer::is_radiance(sky)) fail(text, "a radiance: three numbers from 0 to 1e30");
  return sky;
}

tracer::Vec2i parse_size_px(const std::string& text) {
  const auto size = read_pair(text, 'x');
  if (!size || size->x < 1 || size->y < 1 || size->x > max_side_px || size->y > max_side_px) {
    fail(text, fmt::format("a size such as 1280x720, each side 1 to {}", max_side_px));
  }
  return *size;
}

tracer::Vec2i parse_pixel(const std::string& text) {
  const auto pixel = read_pair(text, ',');
  if (!pixel || pixel->x < 0 || pixel->y < 0) {
    fail(text, "a pixel such as 640,360, counted from the upper left corner 0,0");
  }
  return *pixel;
}

tracer::SunPosition parse_sun(const std::string& text) {
  const size_t comma = text.find(',');
  if (comma == std::string::npos) fail(text, "ELEVATION,AZIMUTH in degrees such as 30,120");
  return {parse_number(text.substr(0, comma), 0, 90),
          parse_number(text.substr(comma + 1), -360, 360)};
}

CLI::Option* add_value(CLI::App& app, const std::string& names, const std::string& value_name,
                       const std::string& help, std::function<void(const std::string&)> read) {
  const std::string option_name = names.substr(names.find_last_of(',') + 1);
  const std::function<void(const std::string&)> checked =
      [option_name, read = std::move(read)](const std::string& text) {
        try {
          read(text);
        } catch (const std::invalid_argument& error) {
          throw CLI::ValidationError(option_name, error.what());
        }
      };
  // The text stands for all that CLI11 would add, such as what an option needs.
  return app.add_option_function<std::string>(names, checked, help)
      ->type_name(value_name)
      ->option_text(value_name);
}

CLI::Option* add_path(CLI::App& app, const std::string& names, const std::string& value_name,
                      const std::string& help,
                      std::function<void(const std::filesystem::path&)> read) {
  const auto read_path = [read = std::move(read)](const std::string& text) {
    if (text.empty()) throw std::invalid_argument("a file's name cannot be empty");
    read(text);
  };
  return add_value(app, names, value_name, help, read_path);
}

void add_environment(CLI::App& app, EnvironmentSource& environment, const std::string& group) {
  CLI::Option* file =
      add_path(app, "--environment", "FILE", "a sky of all directions, .hdr or .exr",
               [&](const auto& path) { environment.file = path; });
  CLI::Option* sun =
      add_value(app, "--sun", "ELEVATION,AZIMUTH", "a clear sky and its sun, in degrees",
                [&](const std::string& text) { environment.sun = parse_sun(text); });
  sun->excludes(file);
  if (group.empty()) return;
  file->group(group);
  sun->group(group);
}

}  // namespace app
