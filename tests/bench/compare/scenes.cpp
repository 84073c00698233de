// SPDX-License-Identifier: MIT
#include "tests/bench/compare/scenes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "tests/support/large_meshes.h"
#include "tracer/scene/import_obj.h"

namespace bench {
namespace {

using tracer::Mesh;
using tracer::Vec3f;

// A camera that the whole model fills, a light over its shoulder.
Scene frame(std::string_view name, std::shared_ptr<const Mesh> mesh) {
  const Vec3f center = mesh->bounds.center();
  const auto radius = static_cast<float>(0.5 * glm::length(mesh->bounds.extent()));
  const Vec3f eye = center + radius * Vec3f(0.8f, 0.6f, 1.6f);
  return {name, std::move(mesh), eye, center, center + radius * Vec3f(-1.5f, 2.5f, 1.2f)};
}

template <const char* file_name>
std::optional<Scene> read_model(std::string_view name, Effort) {
  const std::filesystem::path path = std::string(BOXWOOD_SHARED_DIR "/models/") + file_name;
  if (!std::filesystem::exists(path)) return std::nullopt;
  tracer::Progress progress;
  return frame(name, tracer::import_obj(path, progress).scene.mesh);
}

// Cells a side for a grid of `count` triangles, `count_of_one_cell` to a cell.
int cells_for(double count, double count_of_one_cell, Effort effort) {
  const double wanted = effort == Effort::quick ? count / 10 : count;
  return static_cast<int>(std::sqrt(wanted / count_of_one_cell));
}

std::optional<Scene> make_sphere(std::string_view name, Effort effort) {
  return frame(name,
               std::make_shared<const Mesh>(tracer::bumpy_sphere(cells_for(1e6, 12, effort))));
}

std::optional<Scene> make_hair(std::string_view name, Effort effort) {
  const uint32_t count = effort == Effort::quick ? 100'000 : 1'000'000;
  return frame(name, std::make_shared<const Mesh>(tracer::hair(count, 1)));
}

std::optional<Scene> make_stadium(std::string_view name, Effort effort) {
  return Scene{name, std::make_shared<const Mesh>(tracer::stadium(cells_for(1e5, 12, effort))),
               Vec3f(0.8f, 0.9f, 1.4f), Vec3f(0, 0.4f, 0), Vec3f(3, 5, 2)};
}

std::optional<Scene> make_terrain(std::string_view name, Effort effort) {
  return Scene{name, std::make_shared<const Mesh>(tracer::terrain(cells_for(1e7, 2, effort), 1)),
               Vec3f(-0.9f, 0.8f, 1.0f), Vec3f(0, 0.2f, 0), Vec3f(-2, 1.5f, -1)};
}

constexpr char cow_file[] = "cow.obj";
constexpr char spot_file[] = "spot.obj";
constexpr char bunny_file[] = "stanford-bunny.obj";

constexpr SceneEntry table[] = {
    {"cow", "a small model", true, read_model<cow_file>},
    {"spot", "another", false, read_model<spot_file>},
    {"bunny", "a scan", true, read_model<bunny_file>},
    {"sphere", "a bumpy sphere, 1 M triangles", true, make_sphere},
    {"hair", "1 M long thin triangles, randomly turned", false, make_hair},
    {"stadium", "a ball of 100 k triangles on a floor 10,000 times its size", true, make_stadium},
    {"terrain", "heights, 10 M triangles", false, make_terrain},
};

}  // namespace

std::span<const SceneEntry> scene_entries() {
  return table;
}

}  // namespace bench
