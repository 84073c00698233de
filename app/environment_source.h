// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "tracer/scene/sun_sky.h"

namespace app {

/// What the sky is made of; neither: the constant sky. Not both.
struct EnvironmentSource {
  std::optional<std::filesystem::path> file;
  std::optional<tracer::SunPosition> sun;

  friend bool operator==(const EnvironmentSource&, const EnvironmentSource&) = default;
};

/// A source, and what it says.
struct LoadedEnvironment {
  EnvironmentSource source;
  std::shared_ptr<const tracer::Environment> environment{};

  friend bool operator==(const LoadedEnvironment&, const LoadedEnvironment&) = default;
};

/// nullptr for the constant sky. Throws LoadError.
std::shared_ptr<const tracer::Environment> load_environment(const EnvironmentSource& source);

/// Makes environments as they are asked for: again only what has changed, and a file once.
class EnvironmentMaker {
 public:
  /// Throws LoadError at the first call for a file.
  LoadedEnvironment make(const EnvironmentSource& source);

 private:
  LoadedEnvironment last_;
  LoadedEnvironment map_;
};

}  // namespace app
