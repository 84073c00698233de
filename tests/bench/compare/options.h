// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/compare/scenes.h"

namespace bench {

enum class BuilderChoice { standard, all };
enum class VariantChoice { standard, all };

struct Options {
  std::string command;              // a name of commands()
  std::vector<std::string> scenes;  // or files; empty: all, or those of a quick run
  Effort effort = Effort::full;
  int repeat_count = 5;
  BuilderChoice builders = BuilderChoice::standard;
  double seconds_a_run = 0.4;  // rays are thinned until a run of the slowest takes no more
  // error: seeds, seconds of the longest render and of each half of the reference.
  VariantChoice variants = VariantChoice::standard;
  int seed_count = 16;
  double longest_seconds = 60;
  double reference_seconds = 600;
  std::filesystem::path folder = "build/bench";  // of the files it writes
  // load-once: what a process of its own loads.
  std::string loader;
  std::filesystem::path file;
  int thread_count = 1;
};

/// Nothing where only help was asked for. Throws CLI::Error, std::invalid_argument.
std::optional<Options> parse_options(int argument_count, char** arguments);

/// Makes it, and says where it is missing.
std::optional<Scene> make_scene(const SceneEntry& entry, Effort effort);

}  // namespace bench
