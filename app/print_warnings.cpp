// SPDX-License-Identifier: MIT
#include "app/print_warnings.h"

#include <cstdio>

#include <fmt/format.h>

namespace app {

void print_warnings(const std::filesystem::path& model, const tracer::ImportedScene& imported) {
  const tracer::Warnings& warnings = imported.warnings;
  for (const tracer::Message& message : warnings.messages()) {
    fmt::print(stderr, "{}\n", message.text());
  }
  const auto shown = static_cast<int64_t>(warnings.messages().size());
  if (warnings.count() > shown) {
    fmt::print(stderr, "{}: {} warnings in all, the first {} shown\n", model.string(),
               warnings.count(), shown);
  }
  if (imported.dropped_faces > 0) {
    fmt::print(stderr, "{}: {} {} left out\n", model.string(), imported.dropped_faces,
               imported.dropped_faces == 1 ? "face was" : "faces were");
  }
}

}  // namespace app
