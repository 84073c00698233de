// SPDX-License-Identifier: MIT
#include "tests/bench/compare/error_scenes.h"

#include <memory>
#include <utility>

#include "app/build_accel.h"
#include "tracer/scene/import_obj.h"
#include "tracer/scene/view_file.h"

namespace bench {
namespace {

constexpr ErrorSceneEntry table[] = {
    {"cornell", "the Cornell box, diffuse", BOXWOOD_SHARED_DIR "/scenes/cornell.obj",
     Peers::comparable, false},
    {"cow-sky", "a cow on a floor under a white sky", BOXWOOD_SHARED_DIR "/scenes/cow-sky.obj",
     Peers::comparable, false},
    {"cow-room", "a cow in a closed room with a small lamp, hard indirect light",
     BOXWOOD_SHARED_DIR "/scenes/cow-room.obj", Peers::comparable, false},
    {"glossy-bunny", "a rough golden bunny under two lamps: caustics",
     BOXWOOD_SHARED_DIR "/scenes/glossy-bunny.obj", Peers::comparable, false},
    {"box", "our own Cornell box, which comes with the project",
     BOXWOOD_SOURCE_DIR "/assets/cornell.obj", Peers::none, true},
};

std::shared_ptr<const tracer::Accel> make_tree(const std::shared_ptr<const tracer::Mesh>& mesh,
                                               const tracer::Builder& builder) {
  tracer::Progress progress;
  app::TreeKey key;
  key.builder = &builder;
  key.layout = &tracer::layouts().front();
  return app::build_accel(mesh, key, progress).accel;
}

}  // namespace

std::span<const ErrorSceneEntry> error_scene_entries() {
  return table;
}

std::optional<ErrorScene> load_error_scene(const ErrorSceneEntry& entry, int size_divisor) {
  const std::filesystem::path model = entry.path;
  const std::filesystem::path view_path = tracer::view_path_of(model);
  if (!std::filesystem::exists(model) || !std::filesystem::exists(view_path)) return std::nullopt;
  tracer::Progress progress;
  auto imported = tracer::import_obj(model, progress);
  const auto scene = std::make_shared<const tracer::Scene>(std::move(imported.scene));
  const tracer::View view = tracer::load_view(view_path);
  const tracer::Vec2i size_px = view.size_px.value_or(tracer::Vec2i(512)) / size_divisor;
  return ErrorScene{
      model,
      tracer::World{.scene = scene,
                    .accel = make_tree(scene->mesh, tracer::builders().front()),
                    .camera = tracer::make_camera_frame(view.camera, size_px, scene->mesh->origin),
                    .sky = view.sky.value_or(tracer::World{}.sky),
                    .zenith = tracer::zenith_of(view.camera)},
      size_px};
}

tracer::World with_builder(const tracer::World& world, const tracer::Builder& builder) {
  tracer::World changed = world;
  changed.accel = make_tree(world.scene->mesh, builder);
  return changed;
}

}  // namespace bench
