// SPDX-License-Identifier: MIT
// The scenes that errors are measured on.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tracer/bvh/build.h"
#include "tracer/render/world.h"

namespace bench {

/// Whether Cycles means the same by all of a scene's materials.
enum class Peers { comparable, none };

struct ErrorSceneEntry {
  std::string_view name;  // as on the command line
  std::string_view what;
  const char* path;
  Peers peers;
  bool is_in_quick;
};

std::span<const ErrorSceneEntry> error_scene_entries();

struct ErrorScene {
  std::filesystem::path model;
  tracer::World world;  // its tree by the default builder
  tracer::Vec2i size_px{0, 0};
};

/// The model and the view beside it; nothing where a file is missing. A quick run's picture has a
/// quarter of the width. Throws LoadError.
std::optional<ErrorScene> load_error_scene(const ErrorSceneEntry& entry, int size_divisor);

/// The same scene with a tree of another builder.
tracer::World with_builder(const tracer::World& world, const tracer::Builder& builder);

}  // namespace bench
