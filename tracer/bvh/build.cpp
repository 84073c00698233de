// SPDX-License-Identifier: MIT
#include "tracer/bvh/build.h"

#include <algorithm>
#include <array>

#include "tracer/bvh/build/builders.h"

namespace tracer {
namespace {

constexpr std::array table{
    Builder{"median", "Spatial median",
            "Halves each box across its longest side: quick to build, slow to trace.",
            build_median},
    Builder{"sweep-sah", "SAH, full sweep",
            "Takes the plane of least surface area cost of all: slower to build, fast to trace.",
            build_sweep_sah},
    Builder{"spatial-split", "SAH, spatial splits",
            "Cuts triangles that would make boxes overlap: for long, thin and large ones.",
            build_spatial_split},
};

}  // namespace

std::span<const Builder> builders() {
  return table;
}

const Builder* find_builder(std::string_view name) {
  const auto found = std::ranges::find(table, name, &Builder::name);
  return found == table.end() ? nullptr : &*found;
}

}  // namespace tracer
