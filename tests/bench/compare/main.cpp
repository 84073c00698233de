// SPDX-License-Identifier: MIT
// boxwood_compare rays|build|orbit: see --help.
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tests/bench/compare/commands.h"

int main(int argument_count, char** arguments) {
  try {
    const auto options = bench::parse_options(argument_count, arguments);
    if (!options) return 0;
    if (options->command == "rays") return bench::compare_rays(*options);
    if (options->command == "build") return bench::compare_builds(*options);
    return bench::measure_orbit(*options);
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
