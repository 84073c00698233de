// SPDX-License-Identifier: MIT
#include "app/command_parser.h"
#include "app/commands.h"
#include "app/exit_code.h"
#include "app/info_command.h"
#include "app/option_values.h"

namespace app {
namespace {

std::vector<const tracer::Builder*> parse_builders(const std::string& text) {
  if (text == "off") return {};
  std::vector<const tracer::Builder*> all;
  for (const tracer::Builder& builder : tracer::builders()) all.push_back(&builder);
  if (text == "all") return all;
  if (const tracer::Builder* builder = tracer::find_builder(text)) return {builder};
  throw std::invalid_argument(
      fmt::format("'{}' is none of {}, all, off", text, names_in(tracer::builders())));
}

void add_trees(CLI::App& app, InfoOptions& options) {
  const char* group = "Bounding volume hierarchy";
  add_value(app, "--bvh", "NAME|all|off",
            fmt::format("whose tree is measured: {}, all, off [{}]", names_in(tracer::builders()),
                        tracer::builders().front().name),
            [&](const std::string& text) { options.builders = parse_builders(text); })
      ->group(group);
  add_fields(app, group, options.build);
}

}  // namespace

int run_info(const std::vector<std::string>& arguments) {
  CommandParser parser("info",
                       "What is in an OBJ file, what had to be left out, and how good trees are.",
                       "boxwood info MODEL.obj [options]",
                       "  boxwood info cow.obj\n"
                       "  boxwood info cow.obj --bvh all --leaf-size 2\n"
                       "  boxwood info cow.obj --json");
  InfoOptions options;
  CLI::App& app = parser.options();
  add_path(app, "MODEL", "", "an OBJ file", [&](const auto& path) {
    options.model = path;
  })->required();
  app.add_flag_callback(
      "--json", [&] { options.format = InfoOptions::Format::json; },
      "print JSON, for other programs");
  add_trees(app, options);
  if (parser.parse(arguments) == Parsed::help_was_printed) return exit_code::success;
  return info_command(options);
}

}  // namespace app
