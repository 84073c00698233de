// SPDX-License-Identifier: MIT
#include "tests/bench/compare/options.h"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tests/bench/compare/choose.h"
#include "tests/bench/compare/commands.h"
#include "tests/bench/compare/error_scenes.h"
#include "tests/bench/compare/load_files.h"

namespace bench {
namespace {

std::string list_of_commands() {
  std::string list;
  for (const Command& command : commands()) {
    if (command.what.empty()) continue;
    list += fmt::format("  {:<9} {}\n", command.name, command.what);
  }
  return list;
}

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const Command& command : commands()) names.emplace_back(command.name);
  return names;
}

/// What a process tells those that it starts of itself.
void add_hidden_options(CLI::App& app, Options& options) {
  app.add_option("--loader", options.loader)->group("");
  app.add_option("--file", options.file)->group("");
  app.add_option("--threads", options.thread_count)->group("");
}

/// The options of `error`; what a quick run takes unless it is told.
void add_error_options(CLI::App& app, Options& options) {
  app.add_flag_callback(
      "--variants", [&] { options.variants = VariantChoice::all; },
      "error: other samplers, trees and settings too");
  app.add_option("--seeds", options.seed_count, "error: pictures of each kind [16]")
      ->check(CLI::Range(1, 1000));
  app.add_option("--longest", options.longest_seconds, "error: seconds of the longest render [60]")
      ->check(CLI::Range(0.01, 1e5));
  app.add_option("--reference", options.reference_seconds,
                 "error: seconds of each half of the reference [600]")
      ->check(CLI::Range(0.01, 1e6));
}

void shorten_errors(const CLI::App& app, Options& options) {
  if (app.count("--seeds") == 0) options.seed_count = 2;
  if (app.count("--longest") == 0) options.longest_seconds = 1;
  if (app.count("--reference") == 0) options.reference_seconds = 4;
}

}  // namespace

std::optional<Options> parse_options(int argument_count, char** arguments) {
  Options options;
  bool is_quick = false;
  bool has_all_builders = false;
  CLI::App app("Compares Boxwood with others, and measures what a user waits for");
  app.footer("Commands:\n" + list_of_commands() + "\nScenes:\n" + list_of(scene_entries()) +
             "\nScenes of error:\n" + list_of(error_scene_entries()) + "\nFiles of load:\n" +
             list_of(load_files()));
  app.add_option("command", options.command, "what to measure")
      ->required()
      ->check(CLI::IsMember(command_names()));
  app.add_option("scenes,--scenes", options.scenes, "names, separated by commas")->delimiter(',');
  app.add_flag("--quick", is_quick, "few small scenes, 3 repeats: done in a minute");
  app.add_flag("--builders", has_all_builders, "rays: trace the trees of every builder");
  CLI::Option* repeats =
      app.add_option("--repeats", options.repeat_count, "rounds")->check(CLI::Range(1, 1000));
  app.add_option("--seconds", options.seconds_a_run, "rays: of one run, at most")
      ->check(CLI::PositiveNumber);
  app.add_option("--folder", options.folder, "where files are written");
  add_error_options(app, options);
  add_hidden_options(app, options);
  try {
    app.parse(argument_count, arguments);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return std::nullopt;
  }
  if (is_quick) options.effort = Effort::quick;
  if (is_quick) shorten_errors(app, options);
  if (is_quick && repeats->count() == 0) options.repeat_count = 3;
  if (has_all_builders) options.builders = BuilderChoice::all;
  return options;
}

std::optional<Scene> make_scene(const SceneEntry& entry, Effort effort) {
  std::optional<Scene> scene = entry.make(entry.name, effort);
  if (!scene) fmt::print("{}: SKIPPED, its model is missing\n", entry.name);
  return scene;
}

}  // namespace bench
