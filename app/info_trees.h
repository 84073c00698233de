// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include <nlohmann/json.hpp>

#include "tracer/bvh/build.h"
#include "tracer/geometry/mesh.h"

namespace app {

/// Builds each builder's tree over the mesh, in the default layout, and measures it and its rays:
/// an array of objects.
nlohmann::ordered_json describe_trees(const std::shared_ptr<const tracer::Mesh>& mesh,
                                      const std::vector<const tracer::Builder*>& builders,
                                      const tracer::BuildSettings& settings);

/// Prints what describe_trees() returned as a table, one column a builder.
void print_trees(const nlohmann::ordered_json& trees);

}  // namespace app
