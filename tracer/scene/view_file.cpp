// SPDX-License-Identifier: MIT
#include "tracer/scene/view_file.h"

#include <algorithm>
#include <string_view>

#include <nlohmann/json.hpp>

#include "tracer/base/error.h"
#include "tracer/base/file_bytes.h"
#include "tracer/base/write_file.h"

namespace tracer {
namespace {

using Json = nlohmann::ordered_json;

constexpr int max_size_px = 65535;
constexpr std::string_view known_keys[] = {"eye", "target", "up", "fov", "size", "sky"};

/// A view file's members, each checked as it is taken.
class ViewReader {
 public:
  ViewReader(const std::filesystem::path& path, const Json& json)
      : path_(path.string()), json_(json) {
    if (!json.is_object()) fail("a view is an object, {\"eye\":[x,y,z],\"target\":[x,y,z],...}");
    for (const auto& member : json.items()) {
      if (std::ranges::find(known_keys, member.key()) == std::end(known_keys)) {
        fail("\"" + member.key() + "\" is unknown; keys are eye, target, up, fov, size, sky");
      }
    }
  }

  bool has(const char* key) const { return json_.contains(key); }

  Vec3d point(const char* key) const {
    const std::optional<Vec3d> value = numbers(key);
    if (!value) fail_at(key, "three finite numbers, [x,y,z]");
    return *value;
  }
  Vec3d radiance(const char* key) const {
    const std::optional<Vec3d> value = numbers(key);
    if (!value || !is_radiance(*value)) {
      fail_at(key, "three numbers from 0 to 1e30, [r,g,b]");
    }
    return *value;
  }
  double fov(const char* key) const {
    const Json& value = json_.at(key);
    const double degrees = value.is_number() ? value.get<double>() : 0;
    if (!(degrees > 0 && degrees < 180)) fail_at(key, "degrees above 0 and below 180");
    return degrees;
  }
  Vec2i size(const char* key) const {
    const Json& value = json_.at(key);
    const auto is_size = [](const Json& item) {
      return item.is_number_integer() && item >= 1 && item <= max_size_px;
    };
    if (!value.is_array() || value.size() != 2 || !is_size(value[0]) || !is_size(value[1])) {
      fail_at(key, "two whole numbers from 1 to 65535, [width,height]");
    }
    return {value[0].get<int>(), value[1].get<int>()};
  }
  [[noreturn]] void fail_at(const char* key, const std::string& what) const {
    fail(std::string("\"") + key + "\" should be " + what);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw LoadError({.path = path_, .what = what});
  }
  std::optional<Vec3d> numbers(const char* key) const {
    if (!json_.contains(key)) return {};
    const Json& value = json_.at(key);
    if (!value.is_array() || value.size() != 3) return {};
    Vec3d result(0);
    for (int axis = 0; axis < 3; ++axis) {
      const Json& item = value[static_cast<size_t>(axis)];
      if (!item.is_number()) return {};
      result[axis] = item.get<double>();
    }
    if (!is_finite(result)) return {};
    return result;
  }

  std::string path_;
  const Json& json_;
};

Json parse_json(const std::filesystem::path& path) {
  const FileBytes file(path);
  const std::string_view bytes = file.bytes();
  try {
    return Json::parse(bytes);
  } catch (const Json::parse_error& error) {
    const std::string_view before = bytes.substr(0, std::min<size_t>(error.byte, bytes.size()));
    const auto line = 1 + std::ranges::count(before, '\n');
    throw LoadError({path.string(), line, "this is not JSON"});
  } catch (const Json::out_of_range&) {
    throw LoadError({.path = path.string(), .what = "a number is too large"});
  } catch (const Json::exception&) {
    throw LoadError({.path = path.string(), .what = "this is no view"});
  }
}

Json to_json(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

bool is_radiance(const Vec3d& rgb) {
  constexpr double largest = 1e30;
  return std::min({rgb.x, rgb.y, rgb.z}) >= 0 && max_abs(rgb) <= largest;
}

View load_view(const std::filesystem::path& path) {
  const Json json = parse_json(path);
  const ViewReader reader(path, json);
  View view;
  view.camera.eye = reader.point("eye");
  view.camera.target = reader.point("target");
  if (view.camera.target == view.camera.eye) reader.fail_at("target", "another point than \"eye\"");
  if (reader.has("up")) view.camera.up = reader.point("up");
  if (view.camera.up == Vec3d(0)) reader.fail_at("up", "a direction, not zero");
  if (reader.has("fov")) view.camera.fov_degrees = reader.fov("fov");
  if (reader.has("size")) view.size_px = reader.size("size");
  if (reader.has("sky")) view.sky = reader.radiance("sky");
  return view;
}

void save_view(const std::filesystem::path& path, const View& view) {
  Json json;
  json["eye"] = to_json(view.camera.eye);
  json["target"] = to_json(view.camera.target);
  json["up"] = to_json(view.camera.up);
  json["fov"] = view.camera.fov_degrees;
  if (view.size_px) json["size"] = {view.size_px->x, view.size_px->y};
  if (view.sky) json["sky"] = to_json(*view.sky);
  write_file(path, json.dump() + '\n');
}

std::filesystem::path view_path_of(const std::filesystem::path& model) {
  std::filesystem::path path = model;
  return path.replace_extension(".view.json");
}

}  // namespace tracer
