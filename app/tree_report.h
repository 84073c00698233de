// SPDX-License-Identifier: MIT
// What the programs that read our JSON learn of a tree.
#pragma once

#include <cstddef>

#include <nlohmann/json.hpp>

#include "tracer/bvh/quality.h"

namespace app {

/// Adds a member for each metric to the object `json`. `bytes` are what rays are traced through.
void add_tree(nlohmann::ordered_json& json, const tracer::TreeMetrics& metrics,
              const tracer::TreeQuality& quality, size_t bytes);

}  // namespace app
