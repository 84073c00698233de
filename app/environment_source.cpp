// SPDX-License-Identifier: MIT
#include "app/environment_source.h"

namespace app {

std::shared_ptr<const tracer::Environment> load_environment(const EnvironmentSource& source) {
  if (source.file) return tracer::load_environment(*source.file);
  return source.sun ? tracer::make_sun_sky(*source.sun) : nullptr;
}

LoadedEnvironment EnvironmentMaker::make(const EnvironmentSource& source) {
  if (last_.source == source) return last_;
  if (source.file && map_.source == source) return last_ = map_;
  last_ = {source, load_environment(source)};
  if (source.file) map_ = last_;
  return last_;
}

}  // namespace app
