// SPDX-License-Identifier: MIT
#include "tracer/bvh/build.h"

#include <algorithm>
#include <array>

#include "tracer/bvh/build/builders.h"

namespace tracer {
namespace {

constexpr std::array table{
    Builder{"binned-sah", "SAH, binned",
            "Takes the cheapest of a few planes by surface area: quick to build, fast to trace.",
            build_binned_sah},
    Builder{"median", "Spatial median",
            "Halves each box across its longest side: quick to build, slow to trace.",
            build_median},
    Builder{"sweep-sah", "SAH, full sweep",
            "Takes the plane of least surface area cost of all: slower to build, fast to trace.",
            build_sweep_sah},
    Builder{"morton", "Morton, quick",
            "Sorts along a space-filling curve: quickest to build, for settings being dragged.",
            build_morton},
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
