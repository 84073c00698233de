// SPDX-License-Identifier: MIT
#include "tests/bench/compare/commands.h"

#include "tests/bench/compare/load_in_child.h"

namespace bench {
namespace {

constexpr Command table[] = {
    {"rays", "rays traced a second, beside Embree", compare_rays},
    {"build", "time and memory of trees, beside Embree", compare_builds},
    {"orbit", "from mouse events to changed pixels", measure_orbit},
    {"kernels", "ray-triangle tests: time against error, beside Embree", compare_kernels},
    {"error", "path tracing: error against time, beside Cycles", compare_errors},
    {"exactness", "what exact leaves cost the traversal", measure_exactness},
    {"load", "loaders of OBJ files: speed, memory, wrong numbers", compare_loads},
    {"launch", "from starting the program to the first traced picture", measure_launch},
    {"load-once", "", load_once},
    {"load-watched", "", load_watched},
};

}  // namespace

std::span<const Command> commands() {
  return table;
}

}  // namespace bench
