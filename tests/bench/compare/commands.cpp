// SPDX-License-Identifier: MIT
#include "tests/bench/compare/commands.h"

namespace bench {
namespace {

constexpr Command table[] = {
    {"rays", "rays traced a second, beside Embree", compare_rays},
    {"build", "time and memory of trees, beside Embree", compare_builds},
    {"orbit", "from mouse events to changed pixels", measure_orbit},
    {"kernels", "ray-triangle tests: time against error, beside Embree", compare_kernels},
    {"exactness", "what exact leaves cost the traversal", measure_exactness},
};

}  // namespace

std::span<const Command> commands() {
  return table;
}

}  // namespace bench
