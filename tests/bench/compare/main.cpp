// SPDX-License-Identifier: MIT
// boxwood_compare COMMAND: see --help.
#include <algorithm>
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tests/bench/compare/commands.h"
#include "tracer/base/freed_memory.h"

int main(int argument_count, char** arguments) {
  tracer::keep_freed_memory();  // as Boxwood does
  try {
    const auto options = bench::parse_options(argument_count, arguments);
    if (!options) return 0;
    return std::ranges::find(bench::commands(), options->command, &bench::Command::name)
        ->run(*options);
  } catch (const CLI::Error& error) {
    fmt::print(stderr, "bench: {}\n", error.what());
    return 2;
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "bench: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench: {}\n", error.what());
    return 1;
  }
}
