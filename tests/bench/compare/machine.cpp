// SPDX-License-Identifier: MIT
#include "tests/bench/compare/machine.h"

#include <chrono>
#include <fstream>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "tests/bench/compare/embree_scene.h"
#include "tests/bench/compare/pinned_threads.h"
#include "tracer/bvh/trace/wide_kernels.h"

namespace bench {
namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

}  // namespace

std::string machine_line() {
  std::string line = fmt::format("{}, {} processors, {} floats a kernel step", processor_name(),
                                 processor_count(), tracer::wide_kernel_width());
#ifdef BOXWOOD_EMBREE
  line += "; " + embree_version();
#endif
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return line + fmt::format("; {:%Y-%m-%d}", fmt::localtime(now));
}

}  // namespace bench
